#include "io/gltf_extras.h"

#include <cmath>

#include "base/error.h"

namespace triad::gltf {
namespace {

using tinygltf::Value;

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

    /// An array of least to most numbers.
    std::vector<double> numbers(const Value& value, const std::string& member, std::size_t least,
                                std::size_t most) const {
        const auto refuse = [&] {
            fail(member, "is not an array of " + std::to_string(least) + " to " + std::to_string(most) +
                             " finite numbers.");
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

Dispersion read_glass(const Reader& reader) {
    const std::string name = reader.text("glass", "the name of a glass");
    if (const auto glass = find_glass(name)) return *glass;
    reader.fail("glass",
                "is '" + name.substr(0, 40) + "', which is not known; there are " + glass_names() + ".");
}

}  // namespace

void apply_material_extras(const Value& extras, const std::string& what, Material& m, const Warn& warn) {
    if (!extras.IsObject() || !extras.Has("triad")) return;
    const Value& triad = extras.Get("triad");
    if (!triad.IsObject()) throw Error(Exit::scene, what + ": extras.triad is not an object.");
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
    for (const std::string& member : triad.Keys())
        if (member != "glass" && member != "cauchy" && member != "sellmeier" && member != "priority")
            warn(what + ": extras.triad." + member.substr(0, 40) + " is not known and is left out.");
}

}  // namespace triad::gltf
