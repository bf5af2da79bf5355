#include "io/exr_header.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <map>
#include <set>

#include "base/error.h"
#include "io/image_container.h"

namespace triad {
namespace {

using Span = std::span<const std::uint8_t>;
static_assert(std::endian::native == std::endian::little,
              "EXR and film files are read and written as they lie in memory");

/// Walks over bytes and refuses to leave them.
class Cursor {
  public:
    Cursor(const std::string& name, Span bytes) : name_(name), bytes_(bytes) {}
    [[noreturn]] void refuse(const std::string& why) const {
        throw Error(Exit::scene, "Image " + name_ + " cannot be used: " + why + ".");
    }
    Span take(std::size_t size) {
        if (size > bytes_.size() - at_) refuse("its EXR header ends early");
        at_ += size;
        return bytes_.subspan(at_ - size, size);
    }
    template <class T>
    T value() {
        T v;
        std::memcpy(&v, take(sizeof v).data(), sizeof v);
        return v;
    }
    std::string text() {  ///< up to a zero; at most 255 characters
        std::string s;
        for (char c; (c = char(value<std::uint8_t>())) != 0; s += c)
            if (s.size() == 255) refuse("its EXR header has a name without end");
        return s;
    }
    std::size_t at() const { return at_; }
    bool done() const { return at_ == bytes_.size(); }

  private:
    const std::string& name_;
    Span bytes_;
    std::size_t at_ = 0;
};

struct Attribute {
    std::string type;
    Span value, whole;
};

struct Box {
    std::int32_t x0, y0, x1, y1;
};

/// What a flat image needs (OpenEXR technical introduction, "Predefined Attributes"), and its type.
const std::map<std::string, std::string> needed{
    {"channels", "chlist"},        {"compression", "compression"}, {"dataWindow", "box2i"},
    {"displayWindow", "box2i"},    {"lineOrder", "lineOrder"},     {"pixelAspectRatio", "float"},
    {"screenWindowCenter", "v2f"}, {"screenWindowWidth", "float"}, {"tiles", "tiledesc"}};

std::vector<std::string> read_channels(const std::string& name, Span value) {
    Cursor list(name, value);
    std::vector<std::string> names;
    for (std::string channel; !(channel = list.text()).empty();) {
        const auto type = list.value<std::int32_t>();
        list.take(4);
        const auto x_sampling = list.value<std::int32_t>(), y_sampling = list.value<std::int32_t>();
        if (type < 0 || type > 2) list.refuse("EXR channel " + channel + " has an unknown type");
        if (x_sampling != 1 || y_sampling != 1)
            list.refuse("EXR channel " + channel + " is subsampled; save it with one value per pixel");
        names.push_back(std::move(channel));
    }
    if (names.empty() || names.size() > 1024) list.refuse("it has no EXR channels, or more than 1024");
    // OpenEXR goes by the list's own end: what follows there it takes for attributes.
    if (!list.done()) list.refuse("its list of EXR channels is longer than it says");
    if (std::set<std::string>(names.begin(), names.end()).size() != names.size())
        list.refuse("it has two EXR channels of one name");
    return names;
}

void add_metadata(Metadata& metadata, const std::string& name, const Attribute& a) {
    const auto number = [&]<class T>(T v) {
        std::memcpy(&v, a.value.data(), sizeof v);
        // Counts in full, others by the digits that tell them apart.
        const bool is_count = std::abs(double(v)) < 1e15 && double(v) == std::trunc(double(v));
        char text[40];
        const char* const end = is_count ? std::to_chars(text, std::end(text), std::int64_t(v)).ptr
                                         : std::to_chars(text, std::end(text), v).ptr;
        metadata[name] = std::string(static_cast<const char*>(text), end);
    };
    if (a.type == "string") metadata[name] = {a.value.begin(), a.value.end()};
    if (a.type == "int" && a.value.size() == 4) number(std::int32_t{});
    if (a.type == "float" && a.value.size() == 4) number(float{});
    if (a.type == "double" && a.value.size() == 8) number(double{});
}

/// The bytes with the attributes `kept` alone in their header, which lies from `begin` to `end`. Offsets in
/// the file are absolute, so the header keeps its length: one blank attribute in the place of the foreign.
std::vector<std::uint8_t> with_header(const Cursor& file, Span bytes, std::size_t begin, std::size_t end,
                                      const std::vector<std::uint8_t>& kept) {
    std::vector<std::uint8_t> result(bytes.begin(), bytes.end());
    auto to = std::copy(kept.begin(), kept.end(), result.begin() + std::ptrdiff_t(begin));
    const std::size_t gap = end - 1 - begin - kept.size();
    if (gap > 0) {
        constexpr char blank[] = "x\0string";  // with its closing zero
        if (gap < sizeof blank + 4) file.refuse("its EXR header has an attribute without a type");
        const auto size = std::uint32_t(gap - sizeof blank - 4);
        to = std::copy(std::begin(blank), std::end(blank), to);
        std::memcpy(&*to, &size, 4);
        std::fill_n(to + 4, size, std::uint8_t(' '));
    }
    result[end - 1] = 0;
    return result;
}

}  // namespace

CleanExr clean_exr(const std::string& name, Span bytes) {
    Cursor file(name, bytes);
    file.take(4);  // the magic, already seen
    const auto version = file.value<std::uint32_t>();
    constexpr std::uint32_t tiled_flag = 0x200, long_names_flag = 0x400;
    if ((version & 0xff) != 2) file.refuse("its EXR version is not 2");
    if (version & ~(0xffu | tiled_flag | long_names_flag))
        file.refuse("it is a deep or multi-part EXR; save it as one flat part");

    CleanExr clean;
    std::map<std::string, Attribute> header;
    std::vector<std::uint8_t> kept;
    const std::size_t begin = file.at();
    for (;;) {
        const std::size_t start = file.at();
        const std::string key = file.text();
        if (key.empty()) break;
        Attribute a{file.text(), {}, {}};
        const auto size = file.value<std::int32_t>();
        if (size < 0) file.refuse("its EXR attribute " + key + " has a negative size");
        a.value = file.take(std::size_t(size));
        a.whole = bytes.subspan(start, file.at() - start);
        const auto known = needed.find(key);
        const bool keep = known != needed.end() && known->second == a.type && !header.contains(key);
        if (keep) {
            header[key] = a;
            kept.insert(kept.end(), a.whole.begin(), a.whole.end());
        } else {
            add_metadata(clean.metadata, key, a);
        }
    }
    const std::size_t end = file.at();

    const auto need = [&](const char* key, std::size_t size) {
        const auto found = header.find(key);
        if (found == header.end() || (size != 0 && found->second.value.size() != size))
            file.refuse(std::string("its EXR attribute ") + key + " is missing or damaged");
        return found->second.value;
    };
    const auto box = [&](const char* key) {
        Box b;
        std::memcpy(&b, need(key, sizeof b).data(), sizeof b);
        constexpr std::int32_t limit = 1 << 24;
        if (b.x0 > b.x1 || b.y0 > b.y1 || std::min(b.x0, b.y0) < -limit || std::max(b.x1, b.y1) > limit)
            file.refuse(std::string("its EXR attribute ") + key + " is no window");
        return b;
    };
    const Box data = box("dataWindow"), display = box("displayWindow");
    clean.width = unsigned(data.x1 - data.x0 + 1), clean.height = unsigned(data.y1 - data.y0 + 1);
    clean.x = data.x0 - display.x0, clean.y = data.y0 - display.y0;
    clean.display_width = unsigned(display.x1 - display.x0 + 1),
    clean.display_height = unsigned(display.y1 - display.y0 + 1);
    clean.channels = read_channels(name, need("channels", 0));
    const std::uint64_t pixels = std::uint64_t(clean.width) * clean.height;
    if (pixels > max_image_pixels || pixels * clean.channels.size() > max_image_pixels * 8)
        file.refuse("its header says " + std::to_string(clean.width) + " x " + std::to_string(clean.height) +
                    " pixels with " + std::to_string(clean.channels.size()) +
                    " channels, which is beyond the limit");
    if (need("compression", 1)[0] > 9) file.refuse("its EXR compression is unknown");
    if (need("lineOrder", 1)[0] > 2) file.refuse("its EXR line order is unknown");
    for (const auto& [key, size] :
         {std::pair{"pixelAspectRatio", 4}, {"screenWindowCenter", 8}, {"screenWindowWidth", 4}})
        for (const Span value = need(key, size); std::size_t i : {0, 4})
            if (float f; i < value.size() && (std::memcpy(&f, value.data() + i, 4), !(std::abs(f) < 1e6f)))
                file.refuse(std::string("its EXR attribute ") + key + " is not finite");
    if (header.contains("tiles")) need("tiles", 9);  // OpenEXR reads as many bytes, whatever its size
    if (version & tiled_flag) {
        std::uint32_t tile[2];
        std::memcpy(tile, need("tiles", 9).data(), sizeof tile);
        // Tiles that stick out of the picture are where readers have gone wrong (CVE-2026-63422).
        if (tile[0] == 0 || tile[1] == 0 || tile[0] > 4096 || tile[1] > 4096 || clean.width % tile[0] ||
            clean.height % tile[1])
            file.refuse("its EXR tiles do not fit its size; save it by scanlines");
    }

    clean.bytes = with_header(file, bytes, begin, end, kept);
    return clean;
}

}  // namespace triad
