#include "capture/capture_header.h"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <variant>

#include "base/hash.h"
#include "base/text.h"
#include "base/whole_number.h"

namespace triad {
namespace {

using json = nlohmann::json;
using Refuse = std::function<void(const std::string&)>;
using ContentAt = std::function<Recording::Content(std::size_t)>;

/// What writes JSON calls itself for every level.
constexpr int depth_cap = 16;

/// Values are bytes, which text in JSON cannot be.
std::string hex_of(const std::string& bytes) {
    constexpr char digits[] = "0123456789abcdef";
    std::string text;
    for (const char byte : bytes) {
        text += digits[static_cast<unsigned char>(byte) >> 4];
        text += digits[static_cast<unsigned char>(byte) & 15];
    }
    return text;
}

std::string bytes_of(const std::string& hex, const Refuse& refuse) {
    const auto digit = [&](char c) {
        if (c >= '0' && c <= '9') return c - '0';
        if (c >= 'a' && c <= 'f') return c - 'a' + 10;
        refuse("a value of an argument is no hexadecimal number");
        return 0;
    };
    if (hex.size() % 2 != 0) refuse("a value of an argument is no hexadecimal number");
    std::string bytes;
    for (std::size_t i = 0; i + 1 < hex.size(); i += 2) bytes += char(digit(hex[i]) << 4 | digit(hex[i + 1]));
    return bytes;
}

json to_json(const Recording::Argument& argument) {
    if (const auto* place = std::get_if<std::size_t>(&argument)) return *place;
    if (const auto* bytes = std::get_if<std::string>(&argument)) return hex_of(*bytes);
    return nullptr;
}

Recording::Argument argument_of(const json& argument, const Refuse& refuse) {
    if (argument.is_null()) return Recording::NoMemory{};
    if (argument.is_string()) return bytes_of(argument.get<std::string>(), refuse);
    return whole_number<std::size_t>(argument);
}

// Short: there are many of them. The number of their members tells them apart.
json to_json(const Recording::Command& command, ContentTable& contents) {
    if (const auto* write = std::get_if<Recording::Write>(&command))
        return {write->memory, write->offset, contents.place_of(write->content)};
    if (const auto* fill = std::get_if<Recording::FillZero>(&command)) return json::array({fill->memory});
    const auto& launch = std::get<Recording::Launch>(command);
    return {launch.function, launch.arguments, launch.items, launch.local};
}

Recording::Command command_of(const json& command, const ContentAt& content_at, const Refuse& refuse) {
    if (!command.is_array() || command.empty() || command.size() == 2 || command.size() > 4)
        refuse("a command is no fill, no write and no launch");
    const auto number = [&](std::size_t i) { return whole_number<std::uint64_t>(command.at(i)); };
    if (command.size() == 1) return Recording::FillZero{number(0)};
    if (command.size() == 3) return Recording::Write{number(0), number(1), content_at(number(2))};
    return Recording::Launch{number(0), number(1), number(2), number(3)};
}

json to_json(const CaptureOrigin& origin) {
    return {{"triad", origin.version},     {"command", origin.command},
            {"device", origin.device},     {"driver", origin.driver},
            {"platform", origin.platform}, {"platform_version", origin.platform_version},
            {"type", origin.type},         {"local", origin.local}};
}

CaptureOrigin origin_of(const json& origin) {
    const auto text = [&](const char* key) { return origin.at(key).get<std::string>(); };
    return {text("triad"),    text("command"),
            text("device"),   text("driver"),
            text("platform"), text("platform_version"),
            text("type"),     whole_number<std::uint64_t>(origin.at("local"))};
}

Recording::Content text_content(const std::string& text) {
    const auto* const bytes = reinterpret_cast<const std::byte*>(text.data());
    return std::make_shared<const AlignedVector<std::byte>>(bytes, bytes + text.size());
}

std::string text_of(const Recording::Content& content) {
    return {reinterpret_cast<const char*>(content->data()), content->size()};
}

void add_memories(Recording& work, const json& header, const ContentAt& content_at) {
    for (const json& memory : header.at("memories")) {
        Recording::Memory& added = work.memories.emplace_back();
        added.bytes = whole_number<std::uint64_t>(memory.at("bytes"));
        added.read_only = memory.at("read_only").get<bool>();
        if (!memory.at("content").is_null())
            added.content = content_at(whole_number<std::size_t>(memory.at("content")));
    }
}

CapturedArray array_of(const json& array, const ContentAt& content_at, const Refuse& refuse) {
    const auto name = array.at("what").get<std::string>();
    const auto found = std::find(std::begin(captured_array_names), std::end(captured_array_names), name);
    if (found == std::end(captured_array_names)) refuse("its film has an array of an unknown kind");
    return {CapturedArray::What(found - std::begin(captured_array_names)),
            whole_number<std::size_t>(array.at("memory")),
            whole_number<std::uint64_t>(array.at("first_pixel")),
            whole_number<std::uint64_t>(array.at("pixels")),
            content_at(whole_number<std::size_t>(array.at("content")))};
}

}  // namespace

std::size_t ContentTable::place_of(const Recording::Content& content) {
    const auto [known, is_new] = known_.try_emplace(content.get(), contents_.size());
    if (!is_new) return known->second;
    const std::string hash = Hash().add(content->data(), content->size()).hex();
    known->second = by_hash_.try_emplace(hash, contents_.size()).first->second;
    if (known->second == contents_.size()) contents_.push_back(content);
    return known->second;
}

std::string capture_header(const Capture& capture, ContentTable& contents) {
    const Recording& work = capture.work;
    json sources = json::array(), functions = json::array(), memories = json::array(), lists = json::array(),
         commands = json::array(), film = json::array();
    for (const Recording::Source& source : work.sources)
        sources.push_back({{"path", source.path},
                           {"options", source.options},
                           {"text", contents.place_of(text_content(source.text))}});
    for (const Recording::Function& function : work.functions)
        functions.push_back({{"source", function.source}, {"name", function.name}});
    for (const Recording::Memory& memory : work.memories)
        memories.push_back({{"bytes", memory.bytes},
                            {"read_only", memory.read_only},
                            {"content", memory.content ? json(contents.place_of(memory.content)) : json()}});
    for (const auto& list : work.argument_lists) {
        json arguments = json::array();
        for (const Recording::Argument& argument : list) arguments.push_back(to_json(argument));
        lists.push_back(std::move(arguments));
    }
    for (const Recording::Command& command : work.commands) commands.push_back(to_json(command, contents));
    for (const CapturedArray& array : capture.film)
        film.push_back({{"what", captured_array_names[std::size_t(array.what)]},
                        {"memory", array.memory},
                        {"first_pixel", array.first_pixel},
                        {"pixels", array.pixels},
                        {"content", contents.place_of(array.content)}});
    return json{{"origin", to_json(capture.origin)},
                {"film", {{"width", capture.width}, {"height", capture.height}, {"bins", capture.bins}}},
                {"arrays", film},
                {"sources", sources},
                {"functions", functions},
                {"memories", memories},
                {"arguments", lists},
                {"commands", commands},
                {"counted", capture.counted.empty() ? json() : json::parse(capture.counted)}}
        .dump(-1, ' ', false, json::error_handler_t::replace);
}

Capture capture_of_header(const std::string& text, const ContentAt& content_at, const Refuse& refuse) {
    Capture capture;
    try {
        const json header = json::parse(text, [&](int depth, json::parse_event_t, json&) {
            if (depth > depth_cap) refuse("its header nests deeper than any");
            return true;
        });
        capture.origin = origin_of(header.at("origin"));
        const json& film = header.at("film");
        capture.width = whole_number<std::uint64_t>(film.at("width"));
        capture.height = whole_number<std::uint64_t>(film.at("height"));
        capture.bins = whole_number<std::uint64_t>(film.at("bins"));
        Recording& work = capture.work;
        for (const json& source : header.at("sources"))
            work.sources.push_back({source.at("path").get<std::string>(),
                                    text_of(content_at(whole_number<std::size_t>(source.at("text")))),
                                    source.at("options").get<Options>()});
        for (const json& function : header.at("functions"))
            work.functions.push_back(
                {whole_number<std::size_t>(function.at("source")), function.at("name").get<std::string>()});
        add_memories(work, header, content_at);
        for (const json& list : header.at("arguments")) {
            auto& arguments = work.argument_lists.emplace_back();
            for (const json& argument : list) arguments.push_back(argument_of(argument, refuse));
        }
        for (const json& command : header.at("commands"))
            work.commands.push_back(command_of(command, content_at, refuse));
        for (const json& array : header.at("arrays"))
            capture.film.push_back(array_of(array, content_at, refuse));
        const json counted = header.value("counted", json());
        if (!counted.is_null()) capture.counted = counted.dump();
    } catch (const json::exception& error) {
        refuse(std::string("its header is not one: ") + words_of_json(error));
    }
    check_capture(capture, refuse);
    return capture;
}

}  // namespace triad
