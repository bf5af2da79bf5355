#pragma once
/// What the body of a case writes its measurements to.
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "check/check.h"

namespace triad {

class Check {
  public:
    Check(Device& on, CheckLevel at) : device(on), level(at) {}

    Device& device;
    const CheckLevel level;

    /// `full` amounts of work at the full level, fewer below, but `least` if there are as many.
    std::size_t count(std::size_t full, std::size_t least = 256) const;

    /// |value| of something that must not exceed its bound; `what` is formatted only when it will be said.
    template <class... What>
    void at_most(double value, double bound, const What&... what) {
        const double badness = bound > 0 ? value / bound : value > bound ? INFINITY : 0;
        const bool failed = !(value <= bound);
        if (!(badness < worst_badness_) && !failed_by_nan_) {
            worst_badness_ = badness, value_ = value, bound_ = bound, what_ = text(what...);
            failed_by_nan_ = std::isnan(value);
        }
        if (failed) fail(text(what...), ": ", value, " is more than ", bound);
    }
    /// A condition beside the case's own number: not shown unless it fails.
    template <class... What>
    void also_at_most(double value, double bound, const What&... what) {
        holds(value <= bound, what..., ": ", value, " is more than ", bound);
    }
    template <class... What>
    void below(double value, double bound, const What&... what) {
        at_most(value, std::nextafter(bound, -INFINITY), what...);
    }
    template <class... What>
    void near(double value, double expected, double tolerance, const What&... what) {
        at_most(std::abs(value - expected), tolerance, what..., ", ", value, " for ", expected);
    }
    template <class A, class B, class... What>
    void equal(const A& a, const B& b, const What&... what) {
        holds(a == b, what..., " differs");
    }
    template <class... What>
    void above(double value, double bound, const What&... what) {
        holds(value > bound, what..., ": ", value, " is not above ", bound);
    }
    template <class... What>
    void holds(bool true_of_it, const What&... what) {
        if (true_of_it) return;
        ++wrong_;
        fail(what...);
    }

    CheckResult result() const;

  private:
    template <class... Parts>
    static std::string text(const Parts&... parts) {
        if constexpr (sizeof...(parts) == 0) return {};
        std::ostringstream out;
        ((out << parts), ...);
        return out.str();
    }
    template <class... Parts>
    void fail(const Parts&... parts) {
        if (failures_.size() < 8) failures_.push_back(text(parts...));
    }

    double worst_badness_ = -INFINITY, value_ = 0, bound_ = 0;
    bool failed_by_nan_ = false;
    std::string what_;
    std::size_t wrong_ = 0;
    std::vector<std::string> failures_;
};

}  // namespace triad
