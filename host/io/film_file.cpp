/// Film files: "TRIADFILM", three zeros, u32 version, u64 length of the header, the header (JSON), then the
/// sums, half sums and sample numbers as they lie in memory (little endian), and 32 hex digits of XXH3-128
/// over all before.
#include <algorithm>
#include <bit>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string_view>

#include "base/error.h"
#include "base/files.h"
#include "base/hash.h"
#include "io/io.h"

namespace triad {
namespace {

using json = nlohmann::json;
static_assert(std::endian::native == std::endian::little, "film files are written as they lie in memory");

constexpr char magic[12] = {'T', 'R', 'I', 'A', 'D', 'F', 'I', 'L', 'M', 0, 0, 0};
constexpr std::uint32_t version = 1;
constexpr std::size_t prefix = sizeof magic + sizeof(std::uint32_t) + sizeof(std::uint64_t),
                      checksum_size = 32;

json header_of(const Film& film) {
    json ranges = json::array();
    for (const SampleRange& range : film.ranges) ranges.push_back({range.begin, range.end});
    return {{"size", {film.full_width, film.full_height}},
            {"crop", {film.x, film.y, film.width, film.height}},
            {"bins", {film.bins_x, film.bins_y}},
            {"quanta_log2", film.quanta_log2},
            {"ranges", ranges},
            {"counters", film.counters},
            {"scene", film.scene},
            {"settings", film.settings},
            {"settings_text", film.settings_text},
            {"devices", film.devices}};
}

/// The film without its arrays. Throws json::exception or Error through `refuse` when it is no film.
template <class Refuse>
Film film_of(const json& header, const Refuse& refuse) {
    Film film;
    const auto numbers = [&](const char* key, std::initializer_list<unsigned*> to, unsigned limit) {
        if (header.at(key).size() != to.size()) refuse(std::string("its \"") + key + "\" is incomplete");
        std::size_t i = 0;
        for (unsigned* value : to) {
            const auto number = header.at(key).at(i++).get<std::int64_t>();
            if (number < 0 || number > limit) refuse(std::string("its \"") + key + "\" is out of range");
            *value = unsigned(number);
        }
    };
    numbers("size", {&film.full_width, &film.full_height}, 1u << 20);
    numbers("crop", {&film.x, &film.y, &film.width, &film.height}, 1u << 20);
    numbers("bins", {&film.bins_x, &film.bins_y}, 64);
    if (film.width == 0 || film.height == 0 || film.x + film.width > film.full_width ||
        film.y + film.height > film.full_height)
        refuse("its crop is empty or outside its picture");
    if (film.bins() == 0) refuse("it has no bins");
    film.quanta_log2 = header.at("quanta_log2").get<int>();
    if (film.quanta_log2 < -126 || film.quanta_log2 > 126) refuse("its \"quanta_log2\" is out of range");
    for (const json& range : header.at("ranges")) {
        film.ranges.push_back({range.at(0).get<std::uint64_t>(), range.at(1).get<std::uint64_t>()});
        const std::size_t n = film.ranges.size();
        if (film.ranges[n - 1].begin >= film.ranges[n - 1].end ||
            (n > 1 && film.ranges[n - 2].end >= film.ranges[n - 1].begin))
            refuse("its sample ranges are empty or out of order");
    }
    if (film.sample_count() > 0xffffffffu) refuse("it has more than 2^32 - 1 samples per pixel");
    film.counters = header.at("counters").get<decltype(film.counters)>();
    film.scene = header.at("scene").get<std::string>();
    film.settings = header.at("settings").get<std::string>();
    film.settings_text = header.at("settings_text").get<std::string>();
    film.devices = header.at("devices").get<std::vector<std::string>>();
    return film;
}

template <class T>
void append(std::string& to, const std::vector<T>& values) {
    to.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

template <class T>
std::vector<T> take(const char*& from, std::uint64_t count) {
    std::vector<T> values(count);
    std::memcpy(values.data(), from, count * sizeof(T));
    from += count * sizeof(T);
    return values;
}

}  // namespace

void save_film(const std::filesystem::path& path, const Film& film) {
    // Names of devices come from drivers: what is no UTF-8 is replaced.
    const std::string header = header_of(film).dump(-1, ' ', false, json::error_handler_t::replace);
    const std::uint64_t length = header.size();
    std::string bytes(magic, sizeof magic);
    bytes.reserve(prefix + length + (film.sums.size() + film.half_sums.size()) * 8 + film.samples.size() * 4 +
                  checksum_size);
    bytes.append(reinterpret_cast<const char*>(&version), sizeof version);
    bytes.append(reinterpret_cast<const char*>(&length), sizeof length);
    bytes += header;
    append(bytes, film.sums);
    append(bytes, film.half_sums);
    append(bytes, film.samples);
    bytes += Hash().add(bytes.data(), bytes.size()).hex();
    write_file(path, bytes);
}

Film load_film(const std::filesystem::path& path) {
    const auto refuse = [&](const std::string& why) {
        throw Error(Exit::scene, "Film " + path.string() + " cannot be used: " + why + ".");
    };
    const std::vector<std::uint8_t> bytes = read_file(path);
    if (bytes.size() < sizeof magic || std::memcmp(bytes.data(), magic, sizeof magic) != 0)
        refuse("it is no film file");
    if (bytes.size() < prefix + checksum_size) refuse("it ends early");
    std::uint32_t found_version;
    std::uint64_t length;
    std::memcpy(&found_version, bytes.data() + sizeof magic, sizeof found_version);
    std::memcpy(&length, bytes.data() + sizeof magic + sizeof found_version, sizeof length);
    if (found_version != version)
        refuse("its version is " + std::to_string(found_version) + " and this Triad reads version " +
               std::to_string(version));
    const std::size_t body = bytes.size() - checksum_size;
    if (length > body - prefix) refuse("it ends early");

    const char* at = reinterpret_cast<const char*>(bytes.data()) + prefix;
    Film film;
    try {
        film = film_of(json::parse(at, at + length), refuse);
    } catch (const json::exception& e) {
        refuse(std::string("its header is damaged (") + e.what() + ")");
    }
    at += length;
    // At most 2^40 pixels of 2^12 bins: 64 bits hold every product.
    const std::uint64_t pixels = film.pixels(), sums = pixels * film.bins() * 4;
    const std::uint64_t needed = sums * 8 + pixels * (3 * 8 + 4), have = body - prefix - length;
    if (needed != have)
        refuse("it has " + std::to_string(have) + " bytes of sums, and its size asks for " +
               std::to_string(needed));
    if (Hash().add(bytes.data(), body).hex() !=
        std::string_view(reinterpret_cast<const char*>(bytes.data()) + body, checksum_size))
        refuse("its checksum does not match its content");
    film.sums = take<std::int64_t>(at, sums);
    film.half_sums = take<std::int64_t>(at, pixels * 3);
    film.samples = take<std::uint32_t>(at, pixels);
    const std::uint64_t least = film.sample_count();
    for (const std::uint32_t n : film.samples)
        if (n < least) refuse("some pixel holds fewer samples than its ranges say");
    return film;
}

}  // namespace triad
