/// Checks of the JSON document against the tables of gltf_rules.cpp.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "base/error.h"
#include "io/gltf_json.h"
#include "io/gltf_rules.h"

namespace triad::gltf {
namespace {

using nlohmann::json;

constexpr double big = 9007199254740992.0;  // 2^53: integers beyond are not exact in JSON
constexpr int node_depth_cap = 4096;

/// Follows a rule's path through the document and checks what it finds there.
class Checker {
  public:
    explicit Checker(json& document) : document_(document) {}

    void check(const Rule& rule, const std::string& path) {
        rule_ = &rule;
        size_ = rule.kind == Kind::index ? length_of(rule.of) : 0;
        where_.clear();
        walk(document_, path);
    }

  private:
    struct Step {
        std::string_view name;  ///< empty: an element
        std::size_t element = 0;
        const json* value = nullptr;
    };

    std::size_t length_of(std::string_view path) const {
        const json* value = &document_;
        while (!path.empty()) {
            const std::size_t dot = std::min(path.find('.'), path.size());
            const auto member =
                value->is_object() ? value->find(std::string(path.substr(0, dot))) : value->end();
            if (!value->is_object() || member == value->end()) return 0;
            value = &*member;
            path.remove_prefix(std::min(dot + 1, path.size()));
        }
        return value->is_array() ? value->size() : 0;
    }

    void walk(json& value, std::string_view path) {
        if (path.empty()) return test(value);
        if (path.starts_with("[]")) {
            if (!value.is_array()) return;  // the array's own rule says so
            for (std::size_t i = 0; i < value.size(); ++i) step({{}, i, &value[i]}, value[i], path.substr(2));
        } else if (path.starts_with("{}")) {
            if (!value.is_object()) return;
            for (auto& [name, member] : value.items()) step({name}, member, path.substr(2));
        } else {
            if (path.front() == '.') path.remove_prefix(1);
            if (!value.is_object()) return;
            const std::size_t end = std::min(path.find_first_of(".[{"), path.size());
            const std::string_view name = path.substr(0, end);
            const auto member = value.find(std::string(name));
            if (member != value.end()) return step({name}, *member, path.substr(end));
            if (end == path.size() && rule_->required) fail("has no \"" + std::string(name) + "\"");
        }
    }

    void step(const Step& step, json& value, std::string_view rest) {
        where_.push_back(step);
        walk(value, rest);
        where_.pop_back();
    }

    void test(json& value) {
        switch (rule_->kind) {
            case Kind::object:
                if (!value.is_object()) fail("is not an object");
                if (rule_->lo > 0 && value.empty()) fail("is empty");
                break;
            case Kind::objects:
                if (!value.is_array()) fail("is not an array");
                for (const json& element : value)
                    if (!element.is_object()) fail("has an element that is not an object");
                if (rule_->lo > 0 && value.empty()) fail("is empty");
                break;
            case Kind::array:
                if (!value.is_array()) fail("is not an array");
                if (rule_->lo > 0 && value.empty()) fail("is empty");
                if (!(double(value.size()) >= rule_->lo && double(value.size()) <= rule_->hi))
                    fail("has " + std::to_string(value.size()) + " elements, where " +
                         std::to_string(int(rule_->lo)) + " must be");
                break;
            case Kind::index: {
                const double i = integer(value);
                if (!(i >= 0 && i < double(size_)))
                    fail("is " + value.dump() + ", but there are " + std::to_string(size_) + " " + rule_->of);
                break;
            }
            case Kind::integer:
                in_range(value, integer(value));
                break;
            case Kind::number:
                if (!value.is_number()) fail("is not a number");
                in_range(value, value.get<double>());
                break;
            case Kind::numbers:
                if (!value.is_array() || double(value.size()) != rule_->lo)
                    fail("is not an array of " + std::to_string(int(rule_->lo)) + " numbers");
                for (const json& element : value)
                    if (!element.is_number() || !(std::abs(element.get<double>()) <= 1e30))
                        fail("has an element that is not a (reasonable) number: " + element.dump());
                break;
            case Kind::text:
                if (!value.is_string()) fail("is not a string");
                break;
            case Kind::boolean:
                if (!value.is_boolean()) fail("is not true or false");
                break;
        }
    }

    /// The value as an integer; 3.0 is rewritten as 3, which later readers insist on.
    double integer(json& value) const {
        if (value.is_number_float()) {
            const double x = value.get<double>();
            if (!(x == std::floor(x) && std::abs(x) <= big)) fail("is not an integer: " + value.dump());
            if (x >= 0)
                value = std::uint64_t(x);
            else
                value = std::int64_t(x);
        }
        if (!value.is_number_integer()) fail("is not an integer");
        return value.get<double>();
    }

    void in_range(const json& value, double x) const {
        if (!(x >= rule_->lo && x <= rule_->hi)) fail("is " + value.dump() + ", which is out of range");
    }

    [[noreturn]] void fail(const std::string& what) const {
        std::string text;
        for (const Step& step : where_) {
            if (step.name.empty()) {
                text += "[" + std::to_string(step.element) + "]";
                const auto name = step.value->is_object() ? step.value->find("name") : step.value->end();
                if (step.value->is_object() && name != step.value->end() && name->is_string())
                    text += " '" + name->get<std::string>() + "'";
            } else {
                text += (text.empty() ? "" : ".") + std::string(step.name);
            }
        }
        throw Error(Exit::scene, (text.empty() ? "The glTF document" : text) + " " + what + ".");
    }

    json& document_;
    const Rule* rule_ = nullptr;
    std::size_t size_ = 0;
    std::vector<Step> where_;
};

/// "2.1" -> 2, 1. Throws Error(scene) when it is no such thing.
std::pair<int, int> version_of(const std::string& text, const std::string& member) {
    int major = 0, minor = 0, used = 0;
    if (text.size() > 8 || std::sscanf(text.c_str(), "%d.%d%n", &major, &minor, &used) != 2 ||
        std::size_t(used) != text.size() || major < 0 || minor < 0)
        throw Error(Exit::scene, "asset." + member + " is '" + text + "', which is no version such as 2.0.");
    return {major, minor};
}

void check_version(const json& asset) {
    const auto [major, minor] = version_of(asset["version"].get<std::string>(), "version");
    if (major != 2)
        throw Error(Exit::unsupported,
                    "The file is glTF " + std::to_string(major) + "." + std::to_string(minor) +
                        "; only glTF 2.0 is supported. Convert it with a current exporter.");
    if (!asset.contains("minVersion")) return;
    const std::string text = asset["minVersion"].get<std::string>();
    if (version_of(text, "minVersion") != std::pair(2, 0))
        throw Error(Exit::unsupported,
                    "The file needs glTF " + text + " (asset.minVersion); only 2.0 is supported.");
}

/// Nodes form disjoint trees: one parent at most, no cycle, and no deeper than is sane. Iterative.
void check_trees(const json& document) {
    const auto nodes = document.find("nodes");
    if (nodes == document.end()) return;
    constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    std::vector<std::size_t> parent(nodes->size(), none), wave;
    const auto children_of = [&](std::size_t i) {
        const auto found = (*nodes)[i].find("children");
        return found == (*nodes)[i].end() ? std::vector<std::size_t>{}
                                          : found->get<std::vector<std::size_t>>();
    };
    for (std::size_t i = 0; i < nodes->size(); ++i) {
        for (const std::size_t child : children_of(i)) {
            if (parent[child] != none)
                throw Error(Exit::scene, "nodes[" + std::to_string(child) + "] is a child of both nodes[" +
                                             std::to_string(parent[child]) + "] and nodes[" +
                                             std::to_string(i) + "].");
            parent[child] = i;
        }
    }
    for (std::size_t i = 0; i < nodes->size(); ++i)
        if (parent[i] == none) wave.push_back(i);
    std::vector<bool> reached(nodes->size());
    for (int depth = 0; !wave.empty(); ++depth) {
        if (depth >= node_depth_cap)
            throw Error(Exit::scene, "nodes[" + std::to_string(wave[0]) + "] is more than " +
                                         std::to_string(node_depth_cap) + " levels below its root.");
        std::vector<std::size_t> next;
        for (const std::size_t i : wave) {
            reached[i] = true;
            for (const std::size_t child : children_of(i)) next.push_back(child);
        }
        wave = std::move(next);
    }
    const auto lost = std::find(reached.begin(), reached.end(), false);
    if (lost == reached.end()) return;
    // With one parent each, a node that no root reaches hangs below a cycle: as many steps up as there are
    // nodes end in it.
    std::size_t at = std::size_t(lost - reached.begin());
    for (std::size_t steps = 0; steps < nodes->size(); ++steps) at = parent[at];
    throw Error(Exit::scene,
                "nodes[" + std::to_string(at) + "] is its own ancestor: the node hierarchy has a cycle.");
}

}  // namespace

void check_header(json& document) {
    if (!document.is_object()) throw Error(Exit::scene, "The glTF document is not a JSON object.");
    Checker checker(document);
    for (const Rule& rule : header_rules()) checker.check(rule, rule.path);
    check_version(document["asset"]);
}

void check_document(json& document) {
    Checker checker(document);
    for (const Rule& rule : document_rules()) checker.check(rule, rule.path);
    for (const char* info : texture_infos())
        for (const Rule& rule : texture_rules())
            checker.check(rule, std::string("materials[].") + info + rule.path);
    check_trees(document);
}

}  // namespace triad::gltf
