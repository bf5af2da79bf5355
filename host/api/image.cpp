#include "triad/image.h"

#include <algorithm>
#include <optional>

#include "api/guard.h"
#include "api/parse.h"
#include "api/pictures.h"
#include "base/colour.h"
#include "base/error.h"
#include "metric/flip.h"
#include "metric/image_metrics.h"
#include "panel/perceived.h"
#include "session/metadata.h"
#include "session/output.h"
#include "session/panel_file.h"
#include "session/resolve.h"

namespace triad::api {

namespace {

const char* const channel_names[] = {"R", "G", "B", "A"};

void require_sound(const Image& image, const std::string& what) {
    if (image.width < 1 || image.height < 1 || (image.channels != 3 && image.channels != 4) ||
        image.pixels.size() != std::uint64_t(image.width) * image.height * image.channels)
        throw triad::Error(Exit::usage, what + " has " + std::to_string(image.pixels.size()) +
                                            " values for " + std::to_string(image.width) + " x " +
                                            std::to_string(image.height) + " pixels of " +
                                            std::to_string(image.channels) +
                                            " channels: expected 3 or 4 channels, and a value for each.");
}

/// The channels that both have, and no others.
std::vector<float> values_of(const Image& image, unsigned channels) {
    std::vector<float> values;
    values.reserve(image.pixels.size());
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        if (i % image.channels < channels) values.push_back(image.pixels[i]);
    return values;
}

/// What a display shows.
RgbImage light_of(const Image& image) {
    RgbImage light{image.width, image.height, values_of(image, 3)};
    if (image.encoded)
        for (float& v : light.rgb) v = float(srgb_decode(v));
    return light;
}

}  // namespace

Image image_of(const Picture& picture, const std::string& name) {
    Image image{picture.width, picture.height, picture.find("A") ? 4u : 3u, {}, picture.encoded};
    image.pixels.resize(std::size_t(image.width) * image.height * image.channels);
    for (std::size_t c = 0; c < image.channels; ++c) {
        const Channel* channel = picture.find(channel_names[c]);
        if (!channel) throw triad::Error(Exit::scene, name + " has no channels R, G and B.");
        for (std::size_t i = 0; i < channel->values.size(); ++i)
            image.pixels[i * image.channels + c] = channel->values[i];
    }
    return image;
}

Picture picture_of(const Image& image, const std::string& what) {
    require_sound(image, what);
    Picture picture{.width = image.width, .height = image.height};
    picture.encoded = image.encoded;
    for (std::size_t c = 0; c < image.channels; ++c) {
        Channel channel{channel_names[c], std::vector<float>(std::size_t(image.width) * image.height)};
        for (std::size_t i = 0; i < channel.values.size(); ++i)
            channel.values[i] = image.pixels[i * image.channels + c];
        picture.channels.push_back(std::move(channel));
    }
    return picture;
}

Image read_image(const std::filesystem::path& path) {
    return guarded([&] { return image_of(read_picture(path), path.string()); });
}

Comparison compare(const Image& picture, const Image& reference) {
    return guarded([&]() -> Comparison {
        require_sound(picture, "The picture");
        require_sound(reference, "The reference");
        const auto size = [](const Image& i) {
            return std::to_string(i.width) + "x" + std::to_string(i.height);
        };
        if (picture.width != reference.width || picture.height != reference.height)
            throw triad::Error(Exit::comparison, "The pictures differ in size: one is " + size(picture) +
                                                     ", the reference is " + size(reference) + ".");
        const unsigned channels = std::min(picture.channels, reference.channels);
        const std::vector<float> x = values_of(picture, channels), r = values_of(reference, channels);
        return {.rmse = rmse(x, r),
                .relmse = relmse(x, r),
                .mae = mean_absolute_error(x, r),
                .psnr = psnr(x, r),
                .flip = mean_flip(flip_map(light_of(picture), light_of(reference)))};
    });
}

Perceived perceived(const Image& drives, const Image& reference, const std::string& panel, double ppd,
                    const std::string& eye_name) {
    return guarded([&]() -> Perceived {
        require_sound(drives, "The picture");
        require_sound(reference, "The reference");
        const std::optional<Eye> eye = eye_named(eye_name);
        if (!eye)
            throw triad::Error(Exit::usage,
                               "There is no eye '" + eye_name + "'; there are scielab, sharp and flip.");
        const triad::Panel display = panel_named(panel);
        const double seen_at = ppd == 0 ? display.ppd.value_or(usual_ppd) : ppd;
        if (!(seen_at >= 1 && seen_at <= 1000))
            throw triad::Error(Exit::usage, "Pixels per degree are from 1 to 1000, or 0 for the panel's.");
        const RgbImage shown = light_of(drives);
        RgbImage wanted = light_of(reference);
        for (float& v : wanted.rgb) v = v > 0 ? std::min(v, 1.0f) : 0.0f;
        const PerceivedMetric metric(display, wanted, samples_per_pixel(shown, wanted),
                                     {.ppd = seen_at, .eye = *eye});
        const PerceivedError e = metric.of(shown);
        return {e.error, e.lightness, e.colour, e.de_mean, e.de_p95};
    });
}

Image reconstruct(const Image& bins, const Options& options) {
    return guarded([&] {
        OutputStyle style;
        ReconstructRequest request;
        Options rest = options;
        std::string selector;
        if (const auto device = rest.find("device"); device != rest.end())
            selector = device->second, rest.erase(device);
        parse_picture_options(rest, style, request);
        if (style.denoise != Denoiser::off)
            throw triad::Error(Exit::usage,
                               "--denoise is for films, which know their noise; this is a picture.");
        if (bins.encoded && (options.contains("exposure") || options.contains("tonemap")))
            throw triad::Error(Exit::usage,
                               "The picture holds sRGB values that are tone-mapped already: --exposure and "
                               "--tonemap are for linear ones.");
        style.reconstruction = reconstruction_for_pictures(request);
        const BinImage image = bins_of(picture_of(bins, "The picture"), "The picture", style.reconstruction);
        triad::Device device = triad::Device::open({.selector = selector});
        return image_of(linear_picture(device, image, bins.channels == 4, style));
    });
}

}  // namespace triad::api
