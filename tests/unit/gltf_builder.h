#pragma once
/// Small glTF files made in memory, written to a folder of their own and loaded.
#include <cstdint>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/error.h"
#include "io/io.h"
#include "temporary_folder.h"

struct GltfBuilder {
    nlohmann::json document{
        {"asset", {{"version", "2.0"}}}, {"scenes", {{{"nodes", {0}}}}}, {"nodes", {{{"mesh", 0}}}}};
    std::vector<std::uint8_t> bytes;
    TemporaryFolder folder;
    triad::GltfReport report;

    /// Appends data to the buffer; returns the index of its view.
    template <class T>
    std::size_t view(const std::vector<T>& data) {
        bytes.resize((bytes.size() + 3) / 4 * 4);
        const std::size_t offset = bytes.size(), size = data.size() * sizeof(T);
        bytes.resize(offset + size);
        std::memcpy(bytes.data() + offset, data.data(), size);
        document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}});
        return document["bufferViews"].size() - 1;
    }

    template <class T>
    std::size_t accessor(const std::vector<T>& data, const std::string& type, bool normalised = false) {
        const int components = type == "SCALAR" ? 1 : type == "MAT4" ? 16 : type[3] - '0';
        const int component = std::is_same_v<T, std::int8_t>     ? 5120
                              : std::is_same_v<T, std::uint8_t>  ? 5121
                              : std::is_same_v<T, std::int16_t>  ? 5122
                              : std::is_same_v<T, std::uint16_t> ? 5123
                              : std::is_same_v<T, std::uint32_t> ? 5125
                                                                 : 5126;
        nlohmann::json a{{"bufferView", view(data)},
                         {"componentType", component},
                         {"count", data.size() / components},
                         {"type", type}};
        if (normalised) a["normalized"] = true;
        document["accessors"].push_back(a);
        return document["accessors"].size() - 1;
    }

    nlohmann::json& primitive(std::size_t i = 0) { return document["meshes"][0]["primitives"][i]; }

    /// A triangle in mesh 0.
    GltfBuilder& triangle() {
        primitive()["attributes"]["POSITION"] =
            accessor(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
        return *this;
    }

    /// A texture of one PNG of one row: red, half-transparent green.
    GltfBuilder& texture() {
        const std::string png =
            "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAYAAAD0In+"
            "KAAAAD0lEQVR42mP4z8DwHwgbABB5A37EGHKQAAAAAElFTkSuQmCC";
        document["images"].push_back({{"uri", "data:image/png;base64," + png}});
        document["textures"].push_back({{"source", document["images"].size() - 1}});
        return *this;
    }

    triad::Scene load(const triad::GltfChoice& choice = {}) {
        if (!bytes.empty()) {
            std::ofstream((folder / "data bin.dat").string(), std::ios::binary)
                .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
            document["buffers"] = {{{"byteLength", bytes.size()}, {"uri", "data%20bin.dat"}}};
        }
        return load_text(document.dump(), choice);
    }

    triad::Scene load_text(const std::string& text, const triad::GltfChoice& choice = {}) {
        const auto path = folder / "scene.gltf";
        std::ofstream(path, std::ios::binary) << text;
        report = {};
        return triad::load_gltf(path, choice, &report);
    }

    /// The sentence of the error that loading ends with; empty: it does not.
    std::string refusal(triad::Exit expected = triad::Exit::scene) {
        try {
            load();
            return {};
        } catch (const triad::Error& e) {
            return e.exit() == expected ? e.what() : "another exit code: " + std::string(e.what());
        }
    }

    bool warned(const std::string& part) const {
        for (const std::string& warning : report.warnings)
            if (warning.find(part) != std::string::npos) return true;
        return false;
    }
};
