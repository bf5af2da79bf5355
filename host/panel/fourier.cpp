#include "panel/fourier.h"

#include <fftw3.h>

#include <mutex>

namespace triad {
namespace {

using Complex = std::complex<double>;

std::mutex planning;  // FFTW's planner keeps tables of its own

fftw_complex* bits(const Complex* values) {
    return reinterpret_cast<fftw_complex*>(const_cast<Complex*>(values));
}

}  // namespace

Fourier::Fourier(unsigned width, unsigned height) : width_(width), height_(height) {
    std::vector<double> values(size());
    std::vector<Complex> transform(frequencies());
    const std::lock_guard lock(planning);
    forward_ = fftw_plan_dft_r2c_2d(int(height), int(width), values.data(), bits(transform.data()),
                                    FFTW_ESTIMATE | FFTW_UNALIGNED | FFTW_PRESERVE_INPUT);
    backward_ = fftw_plan_dft_c2r_2d(int(height), int(width), bits(transform.data()), values.data(),
                                     FFTW_ESTIMATE | FFTW_UNALIGNED);
}

Fourier::~Fourier() {
    const std::lock_guard lock(planning);
    fftw_destroy_plan(fftw_plan(forward_));
    fftw_destroy_plan(fftw_plan(backward_));
}

void Fourier::forward(std::span<const double> values, std::span<Complex> transform) const {
    fftw_execute_dft_r2c(fftw_plan(forward_), const_cast<double*>(values.data()), bits(transform.data()));
}

void Fourier::backward(std::span<const Complex> transform, std::span<double> values) const {
    std::vector<Complex> scratch(transform.begin(), transform.end());  // FFTW overwrites its input
    fftw_execute_dft_c2r(fftw_plan(backward_), bits(scratch.data()), values.data());
}

}  // namespace triad
