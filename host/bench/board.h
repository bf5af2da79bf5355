#pragma once
/// What `triad bench device` finds of a device with its driver, as plain rows: what is printed, drawn,
/// written, and read again to be set beside other boards.
#include <string>
#include <vector>

#include "metric/repetitions.h"

namespace triad {

/// The parts of a bench, in the order in which they are measured and shown.
enum class BoardPart {
    check,       ///< a case of triad check: its value and bound
    peak,        ///< arithmetic and memory
    rays,        ///< of one kind in one scene
    paths,       ///< the whole path tracer on one picture
    stage,       ///< a kernel of it
    display,     ///< a kernel on the way from bins to pixels
    function,    ///< a function of the kernels, alone in one
    error,       ///< relMSE of a picture after some samples and seconds
    efficiency,  ///< of a scene: 1 / (relMSE x seconds)
};
constexpr BoardPart all_board_parts[] = {BoardPart::check,    BoardPart::peak,  BoardPart::rays,
                                         BoardPart::paths,    BoardPart::stage, BoardPart::display,
                                         BoardPart::function, BoardPart::error, BoardPart::efficiency};

/// One number. Which of two is better follows from the unit: of times and errors the lower, of rates the
/// higher.
struct BoardRow {
    BoardPart part = BoardPart::check;
    std::string name;                 ///< of the case, scene, kernel ...
    std::string format, path_driver;  ///< empty: it depends on neither
    Estimate value;
    std::string unit;
    bool is_right = true;
    std::string note;             ///< what there is to say of it; empty: nothing
    double spp = 0, seconds = 0;  ///< of an error: samples per pixel, and rendering them
};

/// "wave, bvh8"; empty where the row depends on neither.
std::string way_of(const BoardRow& row);
bool is_time(const std::string& unit);

/// A device with its driver, on a machine.
struct Board {
    std::string device, driver, platform, machine, version;
    double seconds = 0;  ///< that the bench took
    std::vector<BoardRow> rows;
    std::vector<std::string> left_out;  ///< a sentence each: what was not measured, and why

    bool is_right() const;
    std::vector<const BoardRow*> of(BoardPart part) const;
};

/// "check", "peak" ...; throws std::invalid_argument for another name.
std::string name_of(BoardPart part);
BoardPart board_part(const std::string& name);
/// A heading for people.
std::string title_of(BoardPart part);

}  // namespace triad
