#include "bench/time_plan.h"

#include <algorithm>
#include <numeric>

namespace triad {

double TimePlan::guesses_from(std::size_t step) const {
    return std::accumulate(guesses_.begin() + std::ptrdiff_t(std::min(step, guesses_.size())), guesses_.end(),
                           0.0);
}

/// Of a device and its compiler beside the guesses; of the first steps little follows.
double TimePlan::pace() const {
    constexpr double trust = 10;  // seconds of guesses that came true
    return std::clamp((took_ + trust) / (guessed_ + trust), 0.1, 10.0);
}

bool TimePlan::begin() {
    const double now = elapsed();
    if (is_taken_) guessed_ += guesses_[begun_ - 1], took_ += now - began_;
    const std::size_t step = begun_++;
    began_ = now;
    const double rest = guesses_from(step);
    slice_ = std::max(guesses_[step] * pace(), rest > 0 ? (limit_ - now) * guesses_[step] / rest : 0);
    is_taken_ = step == 0 || guesses_[step] * pace() <= limit_ - now;
    return is_taken_;
}

double TimePlan::left_of_step() const { return std::min(began_ + slice_, limit_) - elapsed(); }

double TimePlan::estimate() const {
    const double at_hand =
        begun_ > 0 && is_taken_ ? std::max(0.0, guesses_[begun_ - 1] * pace() - (elapsed() - began_)) : 0;
    return std::clamp(at_hand + guesses_from(begun_) * pace(), 0.0, std::max(0.0, left()));
}

double TimePlan::done() const {
    const double now = elapsed();
    return now / std::max(now + estimate(), 1e-9);
}

}  // namespace triad
