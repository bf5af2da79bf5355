#pragma once
/// The squared perceived error of a panel's picture as a quadratic form in its drives, frequency by
/// frequency:
///     |E(f)|^2 = d^* A(k) d - 2 Re d^* r(f) R(f) + ...,   f = k + m over the harmonics of the cell,
///     A_ee'(k) = sum_m v_e^*(k + m) v_e'(k + m),   r_ej(f) = v_e^*(f) V(f) u_j,
/// where v_e = V(f) times the transform of the light of output e, V the eye (panel/eye.h) and u_j the light
/// of channel j. Of several eyes it is the sum. One picture of `period` px stands for all.
#include <complex>
#include <functional>
#include <vector>

#include "panel/eye.h"
#include "panel/panel.h"

namespace triad {

class ErrorForm {
  public:
    using Complex = std::complex<double>;
    /// What each eye makes of XYZ at a frequency in cycles per pixel, in the axes of the error, times the
    /// root of its share.
    using Response = std::function<std::vector<dmat3>(double cycles_per_pixel)>;
    /// What a visitor is told of each frequency: its index and f (cycles per pixel) along x and y, and r^* of
    /// each output and channel, [output][3].
    struct Frequency {
        int x, y;
        dvec2 f;
        const Complex* r;
    };

    /// `period`: px, a multiple of the cell. `reach`: frequencies along each axis up to this many cycles per
    /// pixel. Only outputs that feed emitters take part.
    ErrorForm(const Panel& panel, const Response& eye, unsigned period, double reach,
              const std::function<void(const Frequency&, std::size_t outputs)>& visit = {});

    const std::vector<Output>& outputs() const { return outputs_; }
    /// The least multiple of the cell that is at least so many px.
    static unsigned period_of(const Panel& panel, unsigned least);
    /// A at the frequency of these indices (any; it repeats with the cell's frequencies), row by row.
    const Complex* a(int x, int y) const {
        return a_.data() + std::size_t(wrap(y, zone_y_) * zone_x_ + wrap(x, zone_x_)) * count() * count();
    }
    int zone_x() const { return zone_x_; }  ///< number of different indices along x
    int zone_y() const { return zone_y_; }
    std::size_t count() const { return outputs_.size(); }
    /// Mean of the diagonal of A at frequency 0.
    double trace() const { return trace_; }

  private:
    static int wrap(int i, int n) { return (i % n + n) % n; }
    std::vector<Output> outputs_;
    int zone_x_, zone_y_;
    std::vector<Complex> a_;
    double trace_ = 0;
};

/// Of the eyes that have a share, for a panel seen at `ppd` pixels per degree.
ErrorForm::Response eye_responses(const Panel& panel, double ppd, const EyeShares& shares);

}  // namespace triad
