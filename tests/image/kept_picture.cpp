#include "kept_picture.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "io/io.h"

namespace fs = std::filesystem;

namespace triad {
namespace {

constexpr unsigned edge = TileMeans::edge;

std::size_t tiles_across(unsigned width) { return (width + edge - 1) / edge; }
std::size_t kept_tile_count(unsigned width, unsigned height) {
    return tiles_across(width) * tiles_across(height);
}
std::size_t tile_of(std::size_t pixel, unsigned width) {
    return pixel / width / edge * tiles_across(width) + pixel % width / edge;
}

const char* const films_key = "triad:films";
const char* const samples_key = "triad:samples";
const char* const shared_key = "triad:shared_noise";

void add_layer(Picture& picture, const std::string& prefix, const std::vector<float>& rgb) {
    for (std::size_t c = 0; c < 3; ++c) {
        Channel channel{prefix + "RGB"[c], std::vector<float>(rgb.size() / 3)};
        for (std::size_t p = 0; p < channel.values.size(); ++p) channel.values[p] = rgb[3 * p + c];
        picture.channels.push_back(std::move(channel));
    }
}

std::vector<float> layer(const Picture& picture, const std::string& prefix) {
    std::vector<float> rgb(std::size_t(picture.width) * picture.height * 3);
    for (std::size_t c = 0; c < 3; ++c) {
        const Channel* channel = picture.find(prefix + "RGB"[c]);
        if (!channel) throw std::runtime_error("a kept picture without " + prefix + "RGB"[c]);
        for (std::size_t p = 0; p < rgb.size() / 3; ++p) rgb[3 * p + c] = channel->values[p];
    }
    return rgb;
}

}  // namespace

const std::vector<KeptCase>& kept_cases() {
    static const std::vector<KeptCase> all = [] {
        std::vector<KeptCase> found;
        std::ifstream file(TRIAD_SOURCE_DIR "/tests/image/pictures.txt");
        for (std::string line; std::getline(file, line);) {
            if (line.empty() || line[0] == '#') continue;
            const std::size_t colon = line.find(':');
            found.push_back({line.substr(0, colon), line.substr(colon + 1)});
        }
        return found;
    }();
    return all;
}

const KeptCase& kept_case(std::string_view name) {
    for (const KeptCase& c : kept_cases())
        if (c.name == name) return c;
    throw std::out_of_range("there is no kept picture " + std::string(name));
}

void KeptPictureMaker::Moments::add(double value, bool is_first) {
    if (is_first) first = value;
    sum += value - first, squares += (value - first) * (value - first);
}

double KeptPictureMaker::Moments::variance(double n) const {
    return std::max(0.0, squares / n - sum / n * (sum / n)) / (n - 1);
}

void KeptPictureMaker::add(const Film& film) {
    if (films_ == 0) {
        width_ = film.width, height_ = film.height;
        pixels_.resize(film.pixels() * 3);
        tiles_.resize((kept_tile_count(width_, height_) + 1) * 3);
    }
    if (film.width != width_ || film.height != height_)
        throw std::invalid_argument("the films of a kept picture must have one size");
    std::vector<double> sums(tiles_.size());
    for (std::size_t p = 0; p < film.pixels(); ++p) {
        const auto mean = pixel_mean(film, p);
        for (std::size_t c = 0; c < 3; ++c) {
            pixels_[3 * p + c].add(mean[c], films_ == 0);
            sums[tile_of(p, width_) * 3 + c] += mean[c];
            sums[sums.size() - 3 + c] += mean[c];
        }
    }
    for (std::size_t t = 0; t < sums.size(); ++t) tiles_[t].add(sums[t], films_ == 0);
    ++films_;
    samples_ += film.sample_numbers().mean;
}

std::vector<double> KeptPictureMaker::tile_ratios() const {
    std::vector<double> added(tiles_.size()), ratios(tiles_.size(), 1.0);
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        const double v = pixels_[i].variance(films_);
        added[tile_of(i / 3, width_) * 3 + i % 3] += v;
        added[added.size() - 3 + i % 3] += v;
    }
    for (std::size_t t = 0; t < tiles_.size(); ++t)
        if (added[t] > 0) ratios[t] = tiles_[t].variance(films_) / added[t];
    return ratios;
}

KeptPicture KeptPictureMaker::make(bool shared) const {
    const std::vector<double> ratios = tile_ratios();
    KeptPicture kept{width_, height_, films_, samples_, shared};
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        double factor = 1;
        if (kept.shared)
            factor = std::max(
                {1.0, ratios[tile_of(i / 3, width_) * 3 + i % 3], ratios[ratios.size() - 3 + i % 3]});
        kept.mean.push_back(float(pixels_[i].mean(films_)));
        kept.variance.push_back(float(factor * pixels_[i].variance(films_)));
    }
    return kept;
}

fs::path kept_picture_file(const std::string& name) {
    return fs::path(TRIAD_SOURCE_DIR) / "tests/image/pictures" / (name + ".exr");
}

void save(const fs::path& path, const KeptPicture& kept) {
    Picture picture{.width = kept.width, .height = kept.height};
    add_layer(picture, "", kept.mean);
    add_layer(picture, "variance.", kept.variance);
    picture.metadata[films_key] = std::to_string(kept.films);
    picture.metadata[samples_key] = std::to_string(kept.samples);
    picture.metadata[shared_key] = kept.shared ? "yes" : "no";
    fs::create_directories(path.parent_path());
    write_exr(path, picture);
}

KeptPicture load_kept_picture(const fs::path& path) {
    const Picture picture = read_picture(path);
    KeptPicture kept{picture.width, picture.height};
    kept.films = unsigned(std::stoul(picture.metadata.at(films_key)));
    kept.samples = std::stod(picture.metadata.at(samples_key));
    kept.shared = picture.metadata.at(shared_key) == "yes";
    kept.mean = layer(picture, "");
    kept.variance = layer(picture, "variance.");
    return kept;
}

TileMeans tile_means(const KeptPicture& kept) {
    TileMeans means;
    means.width = kept.width, means.height = kept.height;
    means.films = 1, means.samples = kept.samples;
    means.tiles.resize((kept_tile_count(kept.width, kept.height) + 1) * 3);
    // A variance of k degrees of freedom has E[v^2] = (1 + 2 / k) E[v]^2; TileMeans counts as if k were 1.
    const double k = kept.films - 1.0, as_of_one = 3 / (k + 2);
    for (std::size_t i = 0; i < kept.mean.size(); ++i) {
        const double v = kept.variance[i];
        for (const std::size_t t : {tile_of(i / 3, kept.width) * 3 + i % 3, means.tiles.size() - 3 + i % 3}) {
            TileMeans::Tile& tile = means.tiles[t];
            tile.sum += kept.mean[i], tile.variance += v, tile.variance_squares += as_of_one * v * v;
            ++tile.pixels;
        }
    }
    for (TileMeans::Tile& tile : means.tiles)
        if (kept.shared) tile.variance_squares = 3 * tile.variance * tile.variance / k;
    return means;
}

void save_difference(const fs::path& path, const KeptPicture& found, const KeptPicture& reference) {
    Picture picture{.width = found.width, .height = found.height};
    std::vector<float> error(found.mean.size());
    const float ratio = float(reference.samples / found.samples);
    for (std::size_t i = 0; i < error.size(); ++i) {
        const float variance =
            std::max(found.variance[i], ratio * reference.variance[i]) + reference.variance[i];
        const float difference = found.mean[i] - reference.mean[i];
        error[i] = difference == 0 ? 0 : difference / std::sqrt(variance + 1e-30f);
    }
    add_layer(picture, "", found.mean);
    add_layer(picture, "reference.", reference.mean);
    add_layer(picture, "error.", error);
    fs::create_directories(path.parent_path());
    write_exr(path, picture);
}

}  // namespace triad
