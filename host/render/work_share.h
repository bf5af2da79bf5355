#pragma once
/// How several devices share a list of work so that all are busy to its end.
#include <cstddef>
#include <cstdint>
#include <vector>

namespace triad {

/// Items of a list of work, [first, first + count).
struct WorkPiece {
    std::size_t first = 0, count = 0;
};

/// Every device has a part of the list by its pace, takes pieces from the front of it and, when it is empty,
/// from the end of the part that will take longest. So most of a picture stays with one device from pass to
/// pass. Decisions only; not for several threads at once.
class WorkShare {
  public:
    /// `sizes`: what each item costs (samples); `paces`: of each device, the same a second; 0: not known.
    WorkShare(std::vector<std::uint64_t> sizes, std::vector<double> paces);

    /// As it was last measured.
    void set_pace(std::size_t device, double pace) { paces_[device] = pace; }

    /// The next piece for a device: items of this size together (0: a few, nothing is known of it), less
    /// towards the end of the list where others work on it too, at most `most` and at least one. Empty:
    /// nothing is left.
    WorkPiece take(std::size_t device, double fit, std::size_t most);
    bool is_done() const { return left_ == 0; }

  private:
    struct Part {
        std::size_t begin, end;
        std::uint64_t left;  ///< size of its items
    };
    std::vector<std::uint64_t> sizes_;
    std::vector<double> paces_;
    std::vector<Part> parts_;
    std::uint64_t left_ = 0;

    double pace_of(std::size_t device) const;
};

}  // namespace triad
