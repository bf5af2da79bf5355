// The border: kernels/types.h must mean the same bytes to the host's compiler and to the device's.
//
// The structs are read from the text of types.h, so that none can be forgotten. Members are 4-byte scalars,
// structs and arrays of them; when they add up to the size that the host's compiler asserted (TRIAD_SIZE),
// the host has no padding and its offsets are the running sums. The device computes sizes and offsets with
// its own compiler.
#include <regex>

#include "check/cases.h"
#include "check/measurements.h"

namespace triad {
namespace {

struct Struct {
    std::string name;
    std::vector<std::pair<std::string, std::uint32_t>> members;  ///< name, offset
    std::uint32_t size = 0;
};

using Matches = std::sregex_iterator;

std::uint32_t product_of_extents(const std::string& extents,
                                 const std::map<std::string, std::uint32_t>& constants) {
    static const std::regex extent(R"(\[(\w+)\])");
    std::uint32_t product = 1;
    for (Matches match(extents.begin(), extents.end(), extent), end; match != end; ++match) {
        const auto named = constants.find((*match)[1]);
        product *=
            named != constants.end() ? named->second : static_cast<std::uint32_t>(std::stoul((*match)[1]));
    }
    return product;
}

/// types.h and its parts, without comments.
std::string types_h() {
    return std::regex_replace(kernel_source::load("types.h"), std::regex(R"(/\*[^]*?\*/)"), "");
}

std::vector<Struct> structs_of_types_h() {
    const std::string text = types_h();
    std::map<std::string, std::uint32_t> constants, sizes{{"uint", 4}, {"int", 4}, {"float", 4}};
    static const std::regex constant(R"(#define (\w+) (\d+)\b)"),
        whole(R"(typedef struct (\w+) \{([^}]*)\})"), declaration(R"((\w+) ([^;]+);)"),
        declarator(R"((\w+)((?:\[\w+\])*))");
    for (Matches match(text.begin(), text.end(), constant), end; match != end; ++match)
        constants[(*match)[1]] = static_cast<std::uint32_t>(std::stoul((*match)[2]));
    std::vector<Struct> structs;
    for (Matches match(text.begin(), text.end(), whole), end; match != end; ++match) {
        Struct each{(*match)[1], {}, 0};
        const std::string body = (*match)[2];
        for (Matches line(body.begin(), body.end(), declaration); line != end; ++line) {
            const std::string names = (*line)[2];
            for (Matches name(names.begin(), names.end(), declarator); name != end; ++name) {
                each.members.emplace_back((*name)[1], each.size);
                each.size += sizes.at((*line)[1]) * product_of_extents((*name)[2], constants);
            }
        }
        sizes[each.name] = each.size;
        structs.push_back(std::move(each));
    }
    return structs;
}

void structs_have_no_padding(Check& check) {
    const std::string text = types_h();
    const std::vector<Struct> structs = structs_of_types_h();
    const std::regex any_struct(R"(\bstruct\b[^;{]*\{)");  // a declaration alone has no layout
    const auto all = std::distance(Matches(text.begin(), text.end(), any_struct), Matches());
    check.equal(structs.size(), static_cast<std::size_t>(all), "the number of structs found");
    for (const Struct& each : structs)
        check.holds(text.find("TRIAD_SIZE(" + each.name + ", " + std::to_string(each.size) + ");") !=
                        std::string::npos,
                    each.name, "'s members add up to ", each.size);
}

void layout_on_the_device(Check& check) {
    const std::vector<Struct> structs = structs_of_types_h();
    std::string source =
        "#include \"common/language.h\"\n"
        "__kernel void layout(__global uint* out, __global const uchar* memory) {\n"
        "    uint n = 0;\n";
    std::vector<std::pair<std::string, std::uint32_t>> expected;
    for (const Struct& each : structs) {
        source += "    { __global const " + each.name + "* s = (__global const " + each.name + "*)memory;\n";
        source += "    out[n++] = sizeof(" + each.name + ");\n";
        expected.emplace_back(each.name, each.size);
        for (const auto& [member, offset] : each.members) {
            source += "    out[n++] = (uint)((__global const uchar*)&s->" + member + " - memory);\n";
            expected.emplace_back(each.name + "." + member, offset);
        }
        source += "    }\n";
    }
    source += "}\n";
    Device& device = check.device;
    const Buffer out = device.allocate(expected.size() * sizeof(std::uint32_t)),
                 memory = device.allocate(4096);
    device.run(device.build_source("layout.cl", source).kernel("layout"), Arguments().add(out).add(memory), 1,
               1);
    const auto measured = device.download<std::uint32_t>(out);
    for (std::size_t i = 0; i < expected.size(); ++i)
        check.equal(measured[i], expected[i].second, expected[i].first);
}

}  // namespace

void add_layout(std::vector<CheckCase>& cases) {
    using enum CheckLevel;
    cases.insert(cases.end(), {
                                  {"L1", "structs of types.h on the host", standard, structs_have_no_padding},
                                  {"L2", "structs of types.h on the device", quick, layout_on_the_device},
                              });
}

}  // namespace triad
