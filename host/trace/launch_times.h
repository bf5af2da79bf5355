#pragma once
/// How many samples a launch should have, by what those before took.

namespace triad {

/// Of one device. A launch takes a time for each sample and, where a device does thousands side by side, one
/// that hardly depends on how many there are: that of its longest path.
class LaunchTimes {
  public:
    void add(double samples, double seconds);
    /// Of the next launch, which is to take so many seconds; longer, up to five times, where the longest path
    /// would take more than half of them, and never shorter than that path and a quarter. 0: nothing is known
    /// yet.
    double samples_in(double seconds) const;

  private:
    double samples_ = 0, seconds_ = 0, most_samples_ = 0;  ///< of the last; of the largest
    double floor_ = 0, each_ = 0;  ///< seconds: of the longest path, and of a sample beside it
    bool is_known_ = false;        ///< what these are
};

}  // namespace triad
