// The modes of an emulated Grbl and what a line of G-code makes of them: a list of things to do, or the
// number of the error that Grbl answers. Lengths mm, rates mm/min.
#pragma once

#include "core/emulators/grbl/internal/eeprom.h"
#include "core/emulators/grbl/internal/words.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::emulators::internal {

struct Modes {
    int motion = 0; ///< ten times the number of the command, as in Words
    int plane = 170;
    int coordinates = 0; ///< 0 to 5 for G54 to G59
    bool absolute = true, inches = false, inverse_time = false;
    int spindle = 50; ///< M3, M4, M5 times ten
    bool flood = false, mist = false;
    double feed = 0.0;
    double spindle_rpm = 0.0;
    int tool = 0;
    Axes position{}; ///< machine coordinates, at the end of all that was parsed
    Axes g92{};
    std::optional<double> tool_length; ///< mm, of G43.1; nothing: G49

    [[nodiscard]] double tool_length_offset() const { return tool_length.value_or(0.0); }
};

enum class Action {
    move,    ///< through `points`
    probe,   ///< toward the only point
    spindle, ///< the modes of the spindle have changed; waits for rest
    coolant, ///<
    dwell,   ///< `seconds`
    store,   ///< writes the EEPROM
    offset,  ///< the work offset has changed; waits for rest
    pause,   ///< M0
    tool,    ///< M6
    restart, ///< after $RST
    end      ///< M2, M30
};

struct Task {
    Action action = Action::move;
    std::vector<Axes> points{}; ///< machine coordinates
    std::size_t next = 0;       ///< of them that is not planned yet
    bool rapid = false;
    bool inverse_time = false;
    double rate = 0.0; ///< mm/min; 1/min of the whole task with `inverse_time`
    int probe = 0;     ///< 382 to 385
    double seconds = 0.0;
};

struct Parsed {
    int error = 0;
    Modes modes;   ///< afterwards
    Eeprom eeprom; ///< afterwards, if there is a Task that stores it
    std::vector<Task> tasks;
    int line_number = 0; ///< N word; 0: none
};

/// What is added to work coordinates to get machine coordinates.
[[nodiscard]] Axes work_offset(const Modes& modes, const Eeprom& eeprom);

/// `line` without blanks and comments, in capitals.
[[nodiscard]] Parsed
parse_line(std::string_view line, const Modes& modes, const Eeprom& eeprom, const Build& build);
/// What follows `$J=`: one straight move, which changes no mode but the position.
[[nodiscard]] Parsed
parse_jog(std::string_view line, const Modes& modes, const Eeprom& eeprom, const Build& build);

/// Millimetres of a programmed unit of axis number `n`: 1 for degrees, unless a grblHAL takes the axis for a
/// length.
[[nodiscard]] double axis_unit(std::size_t n, bool inches, const Eeprom& eeprom, const Build& build);

/// `[GC:...]` without the brackets' line end.
[[nodiscard]] std::string modes_report(const Modes& modes, bool report_inches, const Build& build);

} // namespace millwright::emulators::internal
