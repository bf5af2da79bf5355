#include "report/board_json.h"

#include <cmath>
#include <stdexcept>

#include "base/files.h"
#include "base/text.h"
#include "base/whole_number.h"

namespace triad {
namespace {

constexpr const char* boards_schema = "triad.bench-device/1";
constexpr std::uint64_t largest_report = 1u << 28;  ///< bytes

Json finite_or_null(double v) { return std::isfinite(v) ? Json(v) : Json(); }

/// Null is what finite_or_null() makes of what no JSON can say.
double number_at(const Json& row, const char* name) {
    const Json& value = row.at(name);
    return value.is_null() ? NAN : value.get<double>();
}

BoardRow row_of(const Json& json) {
    BoardRow row{.part = board_part(json.at("part")),
                 .name = json.at("name"),
                 .format = json.at("format"),
                 .path_driver = json.at("path_driver"),
                 .value = {number_at(json, "value"), number_at(json, "low"), number_at(json, "high")},
                 .unit = json.at("unit"),
                 .is_right = json.at("right"),
                 .note = json.at("note")};
    if (json.contains("spp")) row.spp = json.at("spp");
    if (json.contains("seconds")) row.seconds = json.at("seconds");
    return row;
}

std::vector<Board> boards_of(const Json& json) {
    std::vector<Board> boards;
    for (const Json& b : json.at("boards"))
        boards.push_back({.device = b.at("device"),
                          .driver = b.at("driver"),
                          .platform = b.at("platform"),
                          .machine = b.at("machine"),
                          .version = b.at("version"),
                          .seconds = b.at("seconds"),
                          .rows = {},
                          .left_out = b.at("left_out")});
    for (const Json& row : json.at("rows"))
        boards.at(whole_number<std::size_t>(row.at("board"))).rows.push_back(row_of(row));
    return boards;
}

}  // namespace

Json rows_of(const std::vector<Board>& boards) {
    Json rows = Json::array();
    for (std::size_t board = 0; board < boards.size(); ++board)
        for (const BoardRow& r : boards[board].rows) {
            rows.push_back({{"board", board},
                            {"part", name_of(r.part)},
                            {"name", r.name},
                            {"format", r.format},
                            {"path_driver", r.path_driver},
                            {"value", finite_or_null(r.value.value)},
                            {"low", finite_or_null(r.value.low)},
                            {"high", finite_or_null(r.value.high)},
                            {"unit", r.unit},
                            {"right", r.is_right},
                            {"note", r.note}});
            if (r.spp > 0) rows.back()["spp"] = r.spp;
            if (r.seconds > 0) rows.back()["seconds"] = r.seconds;
        }
    return rows;
}

Json boards_json(const std::vector<Board>& boards) {
    Json json = Json::array();
    for (const Board& b : boards)
        json.push_back({{"device", b.device},
                        {"driver", b.driver},
                        {"platform", b.platform},
                        {"machine", b.machine},
                        {"version", b.version},
                        {"seconds", b.seconds},
                        {"right", b.is_right()},
                        {"left_out", b.left_out}});
    return json;
}

std::vector<Board> read_boards(const std::filesystem::path& path) {
    const auto refuse = [&](const std::string& why) {
        throw Error(Exit::scene, path.string() + " is no report of triad bench device --json: " + why + ".");
    };
    const std::vector<std::uint8_t> file = read_file(path, largest_report);
    const Json json = Json::parse(file.begin(), file.end(), nullptr, false);
    if (!json.is_object()) refuse("that is no JSON object");
    const auto schema = json.find("schema");
    if (schema == json.end() || *schema != boards_schema)
        refuse("its schema is " + (schema == json.end() ? "missing" : schema->dump()) + ", not " +
               boards_schema);
    std::vector<Board> boards;
    try {
        boards = boards_of(json);
    } catch (const std::exception& error) {
        refuse(words_of_json(error));
    }
    if (boards.empty()) refuse("there is no board in it");
    return boards;
}

}  // namespace triad
