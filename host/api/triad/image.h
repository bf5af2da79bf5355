#pragma once
/// Pictures as arrays, and how far two of them are apart.
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "triad/options.h"

namespace triad::api {

/// Float values, row by row from the top, channels interleaved: pixels[(y * width + x) * channels + c].
struct Image {
    unsigned width = 0, height = 0;
    /// 3: R, G, B (Rec. 709, D65); 4: with alpha, by which the colours are multiplied.
    unsigned channels = 3;
    std::vector<float> pixels{};
    bool encoded = false;  ///< sRGB values from a file of 8 or 16 bits, alpha apart; else linear
};

/// Integer values as a PNG file holds them: sRGB, alpha apart; ordered as in Image.
struct Bitmap {
    unsigned width = 0, height = 0, channels = 3;
    unsigned bits = 8;                  ///< of a value: 8, or 16 in the byte order of the machine
    std::vector<std::uint8_t> bytes{};  ///< width * height * channels * bits / 8
};

/// R, G, B, and A where there is one, of an EXR, HDR, PNG or JPEG file. Throws Error(2).
TRIAD_API Image read_image(const std::filesystem::path& path);

/// How far a picture is from a reference: means over all pixels and the channels that both have.
struct Comparison {
    double rmse = 0;    ///< root of the mean of (x - r)^2
    double relmse = 0;  ///< mean of (x - r)^2 / (r^2 + 0.01)
    double mae = 0;     ///< mean of |x - r|
    double psnr = 0;    ///< 10 log10(1 / mean of (x - r)^2), decibels; infinite for equal pictures
    double flip = 0;    ///< LDR-FLIP, 0 to 1, of the values cut to [0, 1]
};

/// Throws Error(7) when the pictures differ in size, Error(1) when one has not as many values as its size
/// says.
TRIAD_API Comparison compare(const Image& picture, const Image& reference);

/// What an eye sees of the difference between what a panel shows and what it should show. In units of about
/// one CIELAB unit at mid grey; means are over all pixels but those at the borders.
struct Perceived {
    double error = 0;      ///< root of lightness^2 + colour^2
    double lightness = 0;  ///< root mean square
    double colour = 0;     ///< root mean square of both colour axes: fringes
    double de_mean = 0;    ///< of CIELAB's colour difference after the eye's blur
    double de_p95 = 0;     ///< 95 % of the pixels have less
};

/// `drives`: what the panel is driven with, linear. `reference`: what there is to be seen, linear in [0, 1],
/// n x n pixels for each of the panel's, n at least 3. `panel`: a name or a file, as of option "panel".
/// `ppd`: pixels per degree; 0: the panel's, or 45. `eye`: "scielab", "sharp" or "flip". Throws Error(7) for
/// sizes that do not fit or are too small, Error.
TRIAD_API Perceived perceived(const Image& drives, const Image& reference, const std::string& panel,
                              double ppd = 0, const std::string& eye = "scielab");

/// The pixels of any renderer's picture as the bins of a smaller one: filtered, made for a panel (option
/// "panel"), mapped to tones. Options: those of `triad resolve` but "output". Throws Error.
TRIAD_API Image reconstruct(const Image& bins, const Options& options);

}  // namespace triad::api
