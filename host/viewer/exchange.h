#pragma once
/// What the page's threads and the thread that renders hand to each other. Every function may be called by
/// any thread.
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "panel/panel.h"
#include "viewer/view_change.h"

namespace triad {

/// A picture as it is shown.
struct ViewFrame {
    std::uint64_t number = 0;                      ///< rises with every one
    unsigned full_width = 0, full_height = 0;      ///< of the whole picture, pixels
    unsigned x = 0, y = 0, width = 0, height = 0;  ///< what of it this covers
    bool partial = false;                          ///< some pixels have no sample yet
    unsigned columns = 0, rows = 0;                ///< of the data: fewer where it is coarse
    std::vector<std::uint8_t> rgba;                ///< sRGB; alpha 0 where there is no sample yet
    std::shared_ptr<const Panel> panel;            ///< whose emitters a magnifier shows; null: none
};

/// A file that the page wants.
struct ViewFile {
    std::string extension;  ///< ".png", ".jpg", ".exr" or ".triadfilm"
    std::promise<std::string> bytes;
};

class Exchange {
  public:
    // The page's side.

    /// False: too many wait already, or the view is closed.
    bool post(const ViewChange& change);
    /// The latest of the whole picture, or of the region; null: there is none.
    std::shared_ptr<const ViewFrame> frame(bool of_region) const;
    struct State {
        std::uint64_t number = 0;
        std::string json;
    };
    /// The latest state as soon as its number is above `seen`; nothing after `seconds`, or when closed.
    std::optional<State> state_after(std::uint64_t seen, double seconds) const;
    /// The bytes of a file of the picture as it is now; nothing where `seconds` do not suffice, too many
    /// wait, or it is closed. Throws the Error of making them.
    std::optional<std::string> file(const std::string& extension, double seconds);

    // The side that renders.

    /// None where one is more urgent than that.
    std::vector<ViewChange> take_changes(Urgency at_most = Urgency::picture);
    std::vector<ViewFile> take_files();
    /// Of what waits: the most urgent.
    Urgency urgency() const;
    bool has_files() const;
    /// Since the oldest change of the picture was posted that was taken since the last call; none: there was
    /// none.
    std::optional<double> seconds_since_move();
    /// Returns the frame's number.
    std::uint64_t show(ViewFrame frame, bool of_region);
    /// There is no region any more.
    void drop_region();
    void tell(std::string json);
    /// Returns when something waits, or after `seconds`.
    void wait(double seconds) const;

    /// Both sides are to end: nothing waits any longer.
    void close();
    bool closed() const;

  private:
    using Clock = std::chrono::steady_clock;

    mutable std::mutex mutex_;
    mutable std::condition_variable changed_, told_;
    std::vector<ViewChange> changes_;
    std::vector<ViewFile> files_;
    Urgency urgency_ = Urgency::none;
    std::optional<Clock::time_point> posted_, taken_;  ///< the oldest change of the picture
    std::shared_ptr<const ViewFrame> whole_, region_;
    std::uint64_t frames_ = 0;
    State state_;
    bool closed_ = false;
};

}  // namespace triad
