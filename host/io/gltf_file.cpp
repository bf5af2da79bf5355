#include "io/gltf_file.h"

#include <algorithm>

#include "base/error.h"
#include "base/files.h"
#include "base/freed_memory.h"
#include "io/gltf_compression.h"
#include "io/gltf_extensions.h"
#include "io/gltf_uri.h"

namespace fs = std::filesystem;

namespace triad::gltf {
namespace {

using nlohmann::json;

constexpr std::uint64_t total_cap = std::uint64_t(16) << 30;  // bytes of all files of a scene
constexpr std::size_t large_text = 1 << 20;
constexpr std::uint64_t free_budget = std::uint64_t(192) << 20;
/// Beside one for each byte of the file, whose JSON or accessors name every place that something is at. More
/// come of lists that many nodes share.
constexpr std::uint64_t free_instances = 1 << 18;
constexpr std::uint64_t budget_per_byte =
    64;  // an 8-bit index of a strip becomes three 32-bit ones; buffers may be shared

/// The policy: required and unknown is refused, used and unknown is left out with a warning.
void check_extensions(const json& document, File& file) {
    const auto list = [&](const char* member) {
        const auto found = document.find(member);
        return found == document.end() ? std::vector<std::string>{} : found->get<std::vector<std::string>>();
    };
    file.report.extensions_used = list("extensionsUsed");
    file.report.extensions_required = list("extensionsRequired");
    for (const std::string& name : file.report.extensions_required)
        if (treatment_of(name) == Treatment::left_out)
            throw Error(Exit::unsupported, "The scene requires the glTF extension " + name +
                                               ", which is not supported; export it without that extension.");
    for (const std::string& name : file.report.extensions_used) {
        if (treatment_of(name) == Treatment::left_out)
            file.warn("The glTF extension " + name + " is not supported and is left out.");
        if (name == "KHR_mesh_quantization") file.quantised = true;
    }
}

Bytes keep(File& file, std::vector<std::uint8_t> bytes) {
    file.storage.push_back(std::move(bytes));
    return file.storage.back();
}

std::string text_of(const json& object, const char* member) {
    const auto found = object.find(member);
    return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

/// Of what is compressed elsewhere in the file.
bool is_fallback(const json& buffer) {
    for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
        if (const json::json_pointer at(std::string("/extensions/") + name + "/fallback");
            buffer.contains(at) && buffer[at] == true)
            return true;
    return false;
}

/// A file that the scene refers to.
fs::path beside(File& file, const std::string& uri, const fs::path& folder, const std::string& what) {
    const fs::path path = resolve_uri(uri, folder, what);
    file.report.files.push_back(path.string());
    return path;
}

void read_buffers(const json& document, const fs::path& folder, const Container& container, File& file) {
    const auto buffers = document.find("buffers");
    if (buffers == document.end()) return;
    std::uint64_t total = 0;
    for (std::size_t i = 0; i < buffers->size(); ++i) {
        const json& buffer = (*buffers)[i];
        const std::string what = label("buffer", i, text_of(buffer, "name"));
        const auto length = buffer["byteLength"].get<std::uint64_t>();
        std::optional<Bytes> bytes;
        if (buffer.contains("uri")) {
            const std::string& uri = buffer["uri"].get_ref<const std::string&>();
            try {
                if (auto data = decode_data_uri(uri, what))
                    bytes = keep(file, std::move(*data));
                else
                    bytes = keep(file, triad::read_file(beside(file, uri, folder, what), file_cap));
            } catch (const Error&) {
                if (!is_fallback(buffer)) throw;  // else an error only when used
            }
        } else if (i == 0 && container.has_binary) {
            bytes = container.binary;
        }
        if (bytes) {
            if (bytes->size() < length)
                throw Error(Exit::scene, what + " says " + std::to_string(length) + " bytes but only " +
                                             std::to_string(bytes->size()) + " are there.");
            if ((total += bytes->size()) > total_cap)
                throw Error(Exit::scene, what + " makes the scene larger than 16 GiB.");
            bytes = bytes->first(length);
        }
        file.buffers.push_back(bytes);
    }
    file.budget += total * budget_per_byte;
    file.instances += total;
}

void check_views(const json& document) {
    const auto views = document.find("bufferViews");
    if (views == document.end()) return;
    for (std::size_t i = 0; i < views->size(); ++i) {
        const json& view = (*views)[i];
        const auto buffer = view["buffer"].get<std::size_t>();
        const auto offset = view.value("byteOffset", std::uint64_t(0)),
                   length = view["byteLength"].get<std::uint64_t>();
        const auto size = document["buffers"][buffer]["byteLength"].get<std::uint64_t>();
        if (offset > size || length > size - offset)
            throw Error(Exit::scene,
                        label("bufferView", i, text_of(view, "name")) + " takes bytes " +
                            std::to_string(offset) + " to " + std::to_string(offset + length) + " of " +
                            label("buffer", buffer, text_of(document["buffers"][buffer], "name")) +
                            ", which has " + std::to_string(size) + ".");
    }
}

void find_images(const json& document, const fs::path& folder, File& file) {
    const auto images = document.find("images");
    if (images == document.end()) return;
    for (std::size_t i = 0; i < images->size(); ++i) {
        const json& image = (*images)[i];
        ImageSource source{label("image", i, text_of(image, "name")), {}, {}};
        const bool has_uri = image.contains("uri"), has_view = image.contains("bufferView");
        if (has_uri == has_view)
            throw Error(Exit::scene, source.name + (has_uri ? " has both a uri and a bufferView."
                                                            : " has no uri and no bufferView."));
        if (has_view) {
            source.bytes = file.view(image["bufferView"].get<int>(), source.name);
        } else {
            const std::string& uri = image["uri"].get_ref<const std::string&>();
            if (auto data = decode_data_uri(uri, source.name)) {
                source.bytes = keep(file, std::move(*data));
            } else {
                source.path = beside(file, uri, folder, source.name);
                source.name += " (" + source.path.filename().string() + ")";
            }
        }
        file.images.push_back(std::move(source));
    }
}

/// An index accessor without bufferView is legal (all zeros or sparse), but tinygltf refuses it with a
/// riddle.
void check_index_accessors(const json& document) {
    const auto meshes = document.find("meshes");
    if (meshes == document.end()) return;
    for (std::size_t m = 0; m < meshes->size(); ++m)
        for (const json& primitive : (*meshes)[m]["primitives"]) {
            if (!primitive.contains("indices")) continue;
            const auto accessor = primitive["indices"].get<std::size_t>();
            if (!document["accessors"][accessor].contains("bufferView"))
                throw Error(Exit::scene, label("mesh", m, text_of((*meshes)[m], "name")) +
                                             ": its index accessor " + std::to_string(accessor) +
                                             " has no bufferView, so all its indices are zero.");
        }
}

/// The parser leaves out what is null or empty: a light would lose its spectrum without a word.
void check_not_empty(const json& value, const std::string& name) {
    if (value.is_null() || (value.is_structured() && value.empty()))
        throw Error(Exit::scene, name + " is empty; give it a value or leave it out.");
    if (!value.is_structured()) return;
    for (const auto& [member, content] : value.items())
        check_not_empty(content,
                        value.is_array() ? name + "[" + member + "]" : name + "." + member.substr(0, 40));
}

void check_extras(const json& list, const char* kind) {
    for (std::size_t i = 0; i < list.size(); ++i)
        if (const auto extras = list[i].find("extras"); extras != list[i].end() && extras->is_object())
            if (const auto triad = extras->find("triad"); triad != extras->end() && !triad->empty())
                check_not_empty(*triad, label(kind, i, text_of(list[i], "name")) + ": extras.triad");
}

void check_extras(const json& document) {
    if (const auto materials = document.find("materials"); materials != document.end())
        check_extras(*materials, "material");
    if (const json::json_pointer lights("/extensions/KHR_lights_punctual/lights"); document.contains(lights))
        check_extras(document[lights], "light");
}

/// Removes members that no part of Triad reads, wherever they are: less to parse, nothing to trip over.
void strip(json& document) {
    for (const char* member : {"buffers", "images", "extras"}) document.erase(member);
    for (const char* list :
         {"meshes", "materials", "accessors", "bufferViews", "scenes", "cameras", "animations", "skins"}) {
        const auto found = document.find(list);
        if (found == document.end()) continue;
        for (json& element : *found) {
            const auto extras = element.find("extras");
            if (extras == element.end()) continue;
            if (std::string_view(list) == "materials" && extras->is_object() && extras->contains("triad"))
                *extras = {{"triad", (*extras)["triad"]}};  // gltf_extras.h
            else
                element.erase(extras);
        }
    }
}

/// tinygltf takes text alone, so that what was checked is written out and parsed once more; the first
/// document is gone before the second one grows.
void parse_model(json document, File& file) {
    const std::string text = document.dump();
    document = nullptr;
    std::string error, warning;
    tinygltf::TinyGLTF parser;
    bool parsed = false;
    try {
        parsed =
            parser.LoadASCIIFromString(&file.model, &error, &warning, text.data(), unsigned(text.size()), "");
    } catch (const std::exception& e) {
        error = e.what();
    }
    std::replace(error.begin(), error.end(), '\n', ' ');
    if (!parsed) throw Error(Exit::scene, "The glTF document is not valid: " + error);
    if (text.size() > large_text) give_back_freed_memory();
}

}  // namespace

std::string label(const char* kind, std::size_t index, const std::string& name) {
    std::string shown = name.substr(0, 80);
    for (char& c : shown)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
            c = '?';  // names are the file's: no escapes on a terminal
    return std::string(kind) + " " + std::to_string(index) + (shown.empty() ? "" : " '" + shown + "'");
}

void File::warn(const std::string& sentence) {
    auto& warnings = report.warnings;
    if (std::find(warnings.begin(), warnings.end(), sentence) == warnings.end()) warnings.push_back(sentence);
}

void File::fault(const std::string& sentence) {
    auto& faults = report.faults;
    if (std::find(faults.begin(), faults.end(), sentence) == faults.end()) faults.push_back(sentence);
    warn(sentence);
}

void File::charge_instances(std::uint64_t count, const std::string& what) {
    if (count > instances)
        throw Error(Exit::scene, what + " is placed more often than a file of this size can justify (" +
                                     std::to_string(count) + " times, " + std::to_string(instances) +
                                     " left).");
    instances -= count;
}

void File::charge(std::uint64_t bytes, const std::string& what) {
    if (bytes > budget)
        throw Error(Exit::scene, what + " needs more memory than a file of this size can justify (" +
                                     std::to_string(bytes) + " bytes, " + std::to_string(budget) + " left).");
    budget -= bytes;
}

Bytes File::view(int buffer_view, const std::string& what) const {
    const tinygltf::BufferView& view = model.bufferViews[std::size_t(buffer_view)];
    const std::optional<Bytes>& buffer = buffers[std::size_t(view.buffer)];
    if (!buffer)
        throw Error(Exit::scene, what + " needs " + label("buffer", std::size_t(view.buffer), "") +
                                     ", which has no uri and no data.");
    return buffer->subspan(view.byteOffset, view.byteLength);
}

json read_document(const fs::path& path) {
    const std::vector<std::uint8_t> bytes = read_container(path);
    json document = parse_json(split_container(bytes).json);
    check_header(document);
    check_document(document);
    return document;
}

Error named(const Error& error, const fs::path& path) {
    const std::string name = path.string(), sentence = error.what();
    return sentence.find(name) != std::string::npos ? error : Error(error.exit(), name + ": " + sentence);
}

File read_file(const fs::path& path) {
    File file;
    file.storage.push_back(read_container(path));
    file.budget = free_budget;
    file.instances = free_instances + file.storage.front().size();
    const Container container = split_container(file.storage.front());
    json document = parse_json(container.json);
    check_header(document);
    check_extensions(document, file);
    check_document(document);
    check_extras(document);
    file.nodes = take_nodes(document);
    read_buffers(document, path.parent_path(), container, file);
    check_views(document);
    decode_meshopt(document, file);
    decode_draco(document, file);
    check_index_accessors(document);
    json images = document.contains("images") ? std::move(document["images"]) : json();
    json model = std::move(document);
    strip(model);
    parse_model(std::move(model), file);
    if (!images.is_null()) find_images(json{{"images", std::move(images)}}, path.parent_path(), file);
    file.report.nodes = file.nodes.size();
    file.report.scenes = file.model.scenes.size();
    return file;
}

}  // namespace triad::gltf
