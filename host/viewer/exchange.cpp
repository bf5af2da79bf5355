#include "viewer/exchange.h"

#include <algorithm>
#include <utility>

namespace triad {
namespace {

constexpr std::size_t most_changes = 256, most_files = 4;

std::chrono::duration<double> duration(double seconds) { return std::chrono::duration<double>(seconds); }

}  // namespace

bool Exchange::post(const ViewChange& change) {
    const std::lock_guard lock(mutex_);
    const Urgency urgency = urgency_of(change);
    if (closed_) return false;
    if (urgency == Urgency::none) return true;
    if (changes_.size() >= most_changes) return false;
    changes_.push_back(change);
    urgency_ = std::max(urgency_, urgency);
    if (urgency == Urgency::picture && !posted_) posted_ = Clock::now();
    changed_.notify_all();
    return true;
}

std::shared_ptr<const ViewFrame> Exchange::frame(bool of_region) const {
    const std::lock_guard lock(mutex_);
    return of_region ? region_ : whole_;
}

std::optional<Exchange::State> Exchange::state_after(std::uint64_t seen, double seconds) const {
    std::unique_lock lock(mutex_);
    told_.wait_for(lock, duration(seconds), [&] { return closed_ || state_.number > seen; });
    if (closed_ || state_.number <= seen) return std::nullopt;
    return state_;
}

std::optional<std::string> Exchange::file(const std::string& extension, double seconds) {
    std::future<std::string> bytes;
    {
        const std::lock_guard lock(mutex_);
        if (closed_ || files_.size() >= most_files) return std::nullopt;
        files_.push_back({extension, {}});
        bytes = files_.back().bytes.get_future();
        changed_.notify_all();
    }
    if (bytes.wait_for(duration(seconds)) != std::future_status::ready) return std::nullopt;
    try {
        return bytes.get();
    } catch (const std::future_error&) {  // it was closed meanwhile
        return std::nullopt;
    }
}

std::vector<ViewChange> Exchange::take_changes(Urgency at_most) {
    const std::lock_guard lock(mutex_);
    if (urgency_ > at_most) return {};
    urgency_ = Urgency::none;
    if (posted_ && !taken_) taken_ = posted_;
    posted_.reset();
    return std::exchange(changes_, {});
}

std::vector<ViewFile> Exchange::take_files() {
    const std::lock_guard lock(mutex_);
    return std::exchange(files_, {});
}

Urgency Exchange::urgency() const {
    const std::lock_guard lock(mutex_);
    return closed_ ? Urgency::picture : urgency_;
}

bool Exchange::has_files() const {
    const std::lock_guard lock(mutex_);
    return !files_.empty();
}

std::optional<double> Exchange::seconds_since_move() {
    const std::lock_guard lock(mutex_);
    if (!taken_) return std::nullopt;
    return std::chrono::duration<double>(Clock::now() - *std::exchange(taken_, {})).count();
}

std::uint64_t Exchange::show(ViewFrame frame, bool of_region) {
    const std::lock_guard lock(mutex_);
    frame.number = ++frames_;
    (of_region ? region_ : whole_) = std::make_shared<const ViewFrame>(std::move(frame));
    return frames_;
}

void Exchange::drop_region() {
    const std::lock_guard lock(mutex_);
    region_.reset();
}

void Exchange::tell(std::string json) {
    const std::lock_guard lock(mutex_);
    ++state_.number;
    state_.json = std::move(json);
    told_.notify_all();
}

void Exchange::wait(double seconds) const {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, duration(seconds),
                      [&] { return closed_ || !changes_.empty() || !files_.empty(); });
}

void Exchange::close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    files_.clear();
    changed_.notify_all();
    told_.notify_all();
}

bool Exchange::closed() const {
    const std::lock_guard lock(mutex_);
    return closed_;
}

}  // namespace triad
