#pragma once
/// One time for many steps: whether the next may begin, until when it may go on, and how long all of them
/// will take.
#include <chrono>
#include <vector>

namespace triad {

class TimePlan {
  public:
    /// All in seconds.
    explicit TimePlan(double limit) : limit_(limit), start_(Clock::now()) {}

    /// Plans a step after all others, which takes so long at a guess.
    void add(double guess) { guesses_.push_back(guess); }
    /// The next step: false where it does not fit into what is left, which the first always does. Either way
    /// the one before it has ended.
    bool begin();

    double elapsed() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
    double left() const { return limit_ - elapsed(); }
    /// What the step at hand may still take: its guess, or more where there is more for all later ones too.
    double left_of_step() const;
    /// The same from its beginning, for a step that first compiles.
    double of_step() const { return slice_; }
    /// Until the last step ends: the guesses, at the pace of those that have ended, but never beyond the
    /// limit.
    double estimate() const;
    double done() const;  ///< of the whole, 0 to 1

  private:
    using Clock = std::chrono::steady_clock;

    double limit_;
    Clock::time_point start_;
    std::vector<double> guesses_;
    std::size_t begun_ = 0;          ///< steps
    double began_ = 0, slice_ = 0;   ///< of the step at hand
    double guessed_ = 0, took_ = 0;  ///< of all steps that were taken and have ended
    bool is_taken_ = false;          ///< the step at hand

    double guesses_from(std::size_t step) const;
    double pace() const;
};

}  // namespace triad
