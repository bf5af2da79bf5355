#include "panel/eye.h"

#include <array>
#include <cmath>

namespace triad {
namespace {

constexpr std::array<const char*, 3> eye_names = {"scielab", "sharp", "flip"};

/// Rows as they are printed; GLM keeps columns.
dmat3 rows(const dvec3& a, const dvec3& b, const dvec3& c) { return glm::transpose(dmat3(a, b, c)); }

/// Two Gaussians of the visual angle exp(-(r / s)^2) with weights that are normalised.
double gaussians(double f, double s1, double w1, double s2, double w2) {
    const auto transform = [f](double s) { return std::exp(-pi * pi * s * s * f * f); };
    return (w1 * transform(s1) + w2 * transform(s2)) / (w1 + w2);
}

/// a1 exp(-b1 f^c1) + a2 exp(-b2 f^c2), 1 at f = 0.
double exponentials(double f, double a1, double b1, double c1, double a2, double b2, double c2) {
    return (a1 * std::exp(-b1 * std::pow(f, c1)) + a2 * std::exp(-b2 * std::pow(f, c2))) / (a1 + a2);
}

/// iCID's band-pass as a low-pass: 1 up to where it crosses 1 for the second time.
double sharp_lightness(double f) {
    return f <= 13.3395 ? 1 : 0.63 * std::pow(f, 0.616) * std::exp(-0.085 * f);
}

/// FLIP's sum of kernels a sqrt(pi / b) exp(-pi^2 r^2 / b), transformed in the plane and normalised.
double flip_blue(double f) {
    const double wide = 34.1 * std::sqrt(0.04), narrow = 13.5 * std::sqrt(0.025);
    return (wide * std::exp(-0.04 * f * f) + narrow * std::exp(-0.025 * f * f)) / (wide + narrow);
}

}  // namespace

std::optional<Eye> eye_named(const std::string& name) {
    for (unsigned i = 0; i < eye_names.size(); ++i)
        if (name == eye_names[i]) return Eye(i);
    return {};
}

const char* eye_name(Eye eye) { return eye_names[unsigned(eye)]; }

dmat3 opponent_of_xyz(Eye eye, const dvec3& white) {
    switch (eye) {
        case Eye::scielab:  // isetcam's cmatrix, XYZ of two degrees
            return rows({.2787336, .7218031, -.1065520}, {-.4487736, .2898056, .0771569},
                        {.0859513, -.5899859, .5011089});
        case Eye::sharp:  // YCC of Reinhard et al. 2008, "Color Imaging"
            return rows({.0556, .9981, -.0254}, {.9510, -.9038, 0}, {.0386, 1.0822, -1.0276});
        case Eye::flip:
            break;
    }
    return linear_lab_of_xyz(white);
}

dvec3 contrast_sensitivity(Eye eye, double f) {
    switch (eye) {
        case Eye::scielab:
            return {gaussians(f, .0283, .921, .133, .105), gaussians(f, .0392, .531, .494, .330),
                    gaussians(f, .0536, .488, .386, .371)};
        case Eye::sharp:
            return {sharp_lightness(f), exponentials(f, 91.228, .0003, 2.803, 74.907, .0038, 2.601),
                    exponentials(f, 5.623, .00001, 3.4066, 41.9363, .083, 1.3684)};
        case Eye::flip:
            break;
    }
    return {std::exp(-.0047 * f * f), std::exp(-.0053 * f * f), flip_blue(f)};
}

dmat3 linear_lab_of_xyz(const dvec3& white) {
    return rows({0, 116 / white.y, 0}, {500 / white.x, -500 / white.y, 0},
                {0, 200 / white.y, -200 / white.z});
}

dvec3 lab_of_xyz(const dvec3& xyz, const dvec3& white) {
    constexpr double d = 6.0 / 29;
    const auto f = [](double t) { return t > d * d * d ? std::cbrt(t) : t / (3 * d * d) + 4.0 / 29; };
    const double x = f(xyz.x / white.x), y = f(xyz.y / white.y), z = f(xyz.z / white.z);
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

EyeResponse::EyeResponse(Eye eye, const dvec3& white)
    : eye_(eye),
      from_opponent_(linear_lab_of_xyz(white) * glm::inverse(opponent_of_xyz(eye, white))),
      to_opponent_(opponent_of_xyz(eye, white)) {}

dmat3 EyeResponse::at(double cycles_per_degree) const {
    const dvec3 h = contrast_sensitivity(eye_, cycles_per_degree);
    return from_opponent_ * dmat3(dvec3(h.x, 0, 0), dvec3(0, h.y, 0), dvec3(0, 0, h.z)) * to_opponent_;
}

}  // namespace triad
