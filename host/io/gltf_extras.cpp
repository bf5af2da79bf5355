#include "io/gltf_extras.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.h"

namespace triad::gltf {
namespace {

using tinygltf::Value;

constexpr std::size_t most_lines = 1000;

std::string plain_number(double x) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", x);
    return text;
}

/// The members of extras.triad, with sentences that say where they are.
class Reader {
  public:
    Reader(const Value& object, std::string what) : object_(object), what_(std::move(what)) {}

    bool has(const char* member) const { return object_.Has(member); }
    const Value& get(const char* member) const { return object_.Get(std::string(member)); }

    [[noreturn]] void fail(const std::string& member, const std::string& sentence) const {
        throw Error(Exit::scene, what_ + ": extras.triad." + member + " " + sentence);
    }

    std::string text(const char* member, const std::string& expected) const {
        if (!get(member).IsString()) fail(member, "is not a string; expected " + expected + ".");
        return get(member).Get<std::string>();
    }

    double finite(const Value& value, const std::string& member) const {
        if (!value.IsNumber() || !std::isfinite(value.GetNumberAsDouble()))
            fail(member, "is not a finite number.");
        return value.GetNumberAsDouble();
    }

    /// An array of least to most numbers.
    std::vector<double> numbers(const Value& value, const std::string& member, std::size_t least,
                                std::size_t most) const {
        const auto refuse = [&] {
            fail(member, "is not an array of " + std::to_string(least) +
                             (most > least ? " to " + std::to_string(most) : "") + " finite numbers.");
        };
        if (!value.IsArray() || value.ArrayLen() < least || value.ArrayLen() > most) refuse();
        std::vector<double> list;
        for (std::size_t i = 0; i < value.ArrayLen(); ++i) {
            const Value& number = value.Get(int(i));
            if (!number.IsNumber() || !std::isfinite(number.GetNumberAsDouble())) refuse();
            list.push_back(number.GetNumberAsDouble());
        }
        return list;
    }

  private:
    const Value& object_;
    const std::string what_;
};

Dispersion read_cauchy(const Reader& reader) {
    Dispersion d{Dispersion::Law::cauchy, 0, {}, {}};
    const auto list = reader.numbers(reader.get("cauchy"), "cauchy", 2, 3);
    std::copy(list.begin(), list.end(), d.b.begin());
    return d;
}

Dispersion read_sellmeier(const Reader& reader) {
    const Value& object = reader.get("sellmeier");
    if (!object.IsObject() || !object.Has("B") || !object.Has("C"))
        reader.fail("sellmeier", "is not an object with \"B\" and \"C\".");
    const auto b = reader.numbers(object.Get("B"), "sellmeier.B", 1, 4);
    const auto c = reader.numbers(object.Get("C"), "sellmeier.C", 1, 4);
    if (b.size() != c.size()) reader.fail("sellmeier", "has a different number of elements in B and C.");
    Dispersion d{Dispersion::Law::sellmeier, 1, {}, {}};
    std::copy(b.begin(), b.end(), d.b.begin());
    std::copy(c.begin(), c.end(), d.c.begin());
    return d;
}

/// "D65" (none) or "E", or an object with one of blackbody, laser and lines.
std::optional<LightSpectrum> read_spectrum(const Reader& reader) {
    using Law = LightSpectrum::Law;
    const Value& value = reader.get("spectrum");
    const std::string kinds = light_spectrum_names() +
                              R"(, {"blackbody": KELVIN}, {"laser": NM} and {"lines": [[NM, POWER], ...]})";
    if (value.IsString()) {
        const std::string name = value.Get<std::string>();
        if (name == "D65") return std::nullopt;
        if (name == "E") return LightSpectrum{};
        reader.fail("spectrum",
                    "is '" + name.substr(0, 40) + "', which is not known; there are " + kinds + ".");
    }
    const auto members = value.IsObject() ? value.Keys() : std::vector<std::string>();
    if (members.size() != 1) reader.fail("spectrum", "is none of " + kinds + ".");
    const Value& content = value.Get(members[0]);
    const std::string member = "spectrum." + members[0].substr(0, 40);
    const auto visible = [&](double w, const std::string& where) {
        if (!(w >= shortest_wavelength && w <= longest_wavelength))
            reader.fail(where, "is " + plain_number(w) +
                                   " nm, which is not visible; give a wavelength from 380 to 780 nm.");
        return w;
    };
    if (members[0] == "blackbody") {
        const double kelvin = reader.finite(content, member);
        if (!(kelvin >= LightSpectrum::least_temperature && kelvin <= LightSpectrum::most_temperature))
            reader.fail(
                member,
                "is " + plain_number(kelvin) +
                    " K; give a temperature from 500 to 1000000 K (a candle has 1900, daylight 6500).");
        return LightSpectrum{Law::blackbody, kelvin, {}};
    }
    if (members[0] == "laser")
        return LightSpectrum{Law::lines, 0, {{visible(reader.finite(content, member), member), 1}}};
    if (members[0] != "lines") reader.fail(member, "is not known; there are " + kinds + ".");
    if (!content.IsArray() || content.ArrayLen() == 0 || content.ArrayLen() > most_lines)
        reader.fail(member, "is not an array of 1 to " + std::to_string(most_lines) + " pairs [NM, POWER].");
    LightSpectrum s{Law::lines, 0, {}};
    for (std::size_t i = 0; i < content.ArrayLen(); ++i) {
        const std::string line = member + "[" + std::to_string(i) + "]";
        const auto pair = reader.numbers(content.Get(int(i)), line, 2, 2);
        if (pair[1] < 0 || pair[1] > 1e30)
            reader.fail(line, "has a power of " + plain_number(pair[1]) + "; give one from 0 to 1e30.");
        s.lines.push_back({visible(pair[0], line), pair[1]});
    }
    if (!s.is_sane()) reader.fail(member, "has no power at all; give some line one above 0.");
    return s;
}

Dispersion read_glass(const Reader& reader) {
    const std::string name = reader.text("glass", "the name of a glass");
    if (const auto glass = find_glass(name)) return *glass;
    reader.fail("glass",
                "is '" + name.substr(0, 40) + "', which is not known; there are " + glass_names() + ".");
}

const Value& members_of(const Value& extras, const std::string& what) {
    const Value& triad = extras.Get("triad");
    if (!triad.IsObject()) throw Error(Exit::scene, what + ": extras.triad is not an object.");
    return triad;
}

void warn_of_others(const Value& triad, std::initializer_list<std::string_view> known,
                    const std::string& what, const Warn& warn) {
    for (const std::string& member : triad.Keys())
        if (std::find(known.begin(), known.end(), member) == known.end())
            warn(what + ": extras.triad." + member.substr(0, 40) + " is not known and is left out.");
}

}  // namespace

void apply_material_extras(const Value& extras, const std::string& what, Material& m, const Warn& warn) {
    if (!extras.IsObject() || !extras.Has("triad")) return;
    const Value& triad = members_of(extras, what);
    const Reader reader(triad, what);
    int laws = 0;
    const auto use = [&](const char* member, Dispersion (*read)(const Reader&)) {
        if (!reader.has(member)) return;
        if (++laws > 1)
            reader.fail(member, "is one of two: only one of glass, cauchy and sellmeier may be given.");
        m.dispersion = read(reader);
        if (!m.dispersion->is_sane())
            reader.fail(member,
                        "gives an index of refraction outside 1 to 10 somewhere from 380 to 780 nm; "
                        "wavelengths are in micrometres, and C is already squared.");
        m.ior = float(m.dispersion->index(line_d));
    };
    use("glass", read_glass);
    use("cauchy", read_cauchy);
    use("sellmeier", read_sellmeier);
    if (reader.has("priority")) {
        const Value& value = reader.get("priority");
        const double p = value.IsNumber() ? value.GetNumberAsDouble() : -1;
        if (!(p >= 0 && p <= most_priority && p == std::floor(p)))
            reader.fail("priority", "is not a whole number from 0 to " + std::to_string(most_priority) + ".");
        m.priority = unsigned(p);
    }
    if (reader.has("spectrum")) {
        m.emission_spectrum = read_spectrum(reader);
        if (m.emission == vec3(0.0f) || m.unlit)
            warn(what + " has a spectrum, but is no light: it has no emissiveFactor above 0, or is unlit.");
    }
    warn_of_others(triad, {"glass", "cauchy", "sellmeier", "priority", "spectrum"}, what, warn);
}

std::optional<LightSpectrum> light_extras(const Value& extras, const std::string& what, const Warn& warn) {
    if (!extras.IsObject() || !extras.Has("triad")) return std::nullopt;
    const Value& triad = members_of(extras, what);
    const Reader reader(triad, what);
    warn_of_others(triad, {"spectrum"}, what, warn);
    return reader.has("spectrum") ? read_spectrum(reader) : std::nullopt;
}

}  // namespace triad::gltf
