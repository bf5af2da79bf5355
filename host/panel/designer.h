#pragma once
/// The optimisation behind design_taps.
#include <complex>
#include <optional>
#include <vector>

#include "panel/design.h"
#include "panel/error_form.h"
#include "panel/fourier.h"

namespace triad {

/// From one input channel to one output: where its taps are, in bins from the corner of the cell.
struct TapFilter {
    std::size_t output;  ///< of the form
    unsigned channel;
    int first_x, first_y;
    unsigned width, height;
    std::size_t begin;  ///< of its taps among all
};

/// Minimises sum_f Phi(f) tr[C (G^*(A + lambda t) G - 2 Re G^*(r + lambda t box))] over taps of finite
/// support whose sums are fixed, by conjugate gradients: Phi and C are the power spectrum and the covariance
/// of pictures, G the transforms of the filters, A and r those of ErrorForm, and lambda pulls to the box of
/// one pixel what the eye hardly sees. Taps on bins see frequencies modulo the bins' alone, where A repeats,
/// so that the form costs one transform of that size for each filter.
class Designer {
  public:
    using Complex = std::complex<double>;
    using Values = std::vector<double>;

    Designer(const Panel& panel, double ppd, const TapDesign& design);

    /// Taps of all filters, one after the other, row by row.
    Values solve() const;

    /// What solve() minimises, less a constant.
    double cost(const Values& taps) const;

    const std::vector<TapFilter>& filters() const { return filters_; }
    const Output& output(const TapFilter& filter) const { return form_.outputs()[filter.output]; }

  private:
    std::optional<std::size_t> fold(int x, int y) const;
    Complex bin(const dvec2& f) const;
    void add(const ErrorForm::Frequency& f, std::size_t outputs);
    void add_pull();
    void add_filter(std::size_t output, unsigned channel, double radius);
    double spacing(unsigned channel) const;
    Values start() const;
    void project(Values& taps) const;
    Values right_side() const;
    Values apply(const Values& taps) const;

    uvec2 bins_;
    double cell_;                                      ///< px^2
    double pull_share_;                                ///< lambda
    unsigned period_;                                  ///< px
    double reach_;                                     ///< cycles per pixel
    Fourier grid_;                                     ///< of the bins of a period
    Values weight_;                                    ///< Phi |bin|^2, folded
    std::vector<std::vector<Complex>> folded_, pull_;  ///< Phi bin r^* by output and channel; that of the box
    ErrorForm form_;
    std::vector<TapFilter> filters_;
    std::size_t count_ = 0;  ///< of taps
};

}  // namespace triad
