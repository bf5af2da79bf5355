#pragma once
/// Discrete Fourier transforms of real arrays in the plane, by FFTW.
#include <complex>
#include <span>
#include <vector>

namespace triad {

/// Of arrays of height x width, row by row. Frequencies are kept for x from 0 to width / 2 only: the others
/// are their conjugates.
class Fourier {
  public:
    Fourier(unsigned width, unsigned height);
    ~Fourier();
    Fourier(const Fourier&) = delete;
    Fourier& operator=(const Fourier&) = delete;

    unsigned width() const { return width_; }
    unsigned height() const { return height_; }
    unsigned columns() const { return width_ / 2 + 1; }  ///< of a transform
    std::size_t size() const { return std::size_t(width_) * height_; }
    std::size_t frequencies() const { return std::size_t(columns()) * height_; }

    /// Sum of x exp(-2 pi i (u x / width + v y / height)). Safe to call from several threads.
    void forward(std::span<const double> values, std::span<std::complex<double>> transform) const;
    /// The sum with the opposite sign over all frequencies, not divided by their number.
    void backward(std::span<const std::complex<double>> transform, std::span<double> values) const;

  private:
    unsigned width_, height_;
    void *forward_, *backward_;
};

}  // namespace triad
