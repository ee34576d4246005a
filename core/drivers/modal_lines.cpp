#include "core/drivers/modal_lines.h"

#include "core/drivers/mdi_lines.h"
#include "core/program/number_format.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace millwright::drivers {

namespace {

using gcode::Dialect;
using gcode::FeedMode;
using gcode::LengthUnit;
using gcode::ModalState;
using program::PathMode;

std::string_view plane_code(gcode::Plane plane) {
    constexpr std::array<std::string_view, 6> codes = {"G17", "G18", "G19", "G17.1", "G18.1", "G19.1"};
    return codes[static_cast<std::size_t>(plane)];
}

std::string_view feed_code(FeedMode mode) {
    return mode == FeedMode::per_minute ? "G94" : mode == FeedMode::inverse_time ? "G93" : "G95";
}

std::string path_code(const ModalState& state) {
    switch (state.path_mode) {
    case PathMode::exact_path:
        return "G61\n";
    case PathMode::exact_stop:
        return "G61.1\n";
    case PathMode::continuous:
        break;
    }
    const bool bounded = state.path_tolerance > 0.0;
    return bounded ? fmt::format("G64 {} {}\n",
                                 number_word('P', state.path_tolerance),
                                 number_word('Q', state.naivecam_tolerance))
                   : "G64\n";
}

/// By its number where it has one: the length is the control's to know.
std::string tool_offset(const ModalState& state) {
    if (state.length_tool > 0) {
        return fmt::format("G43 H{}\n", state.length_tool);
    }
    std::string words;
    for (std::size_t n = 0; n < gcode::axis_count; ++n) {
        if (std::abs(state.tool_offset[n]) > 0.0) {
            words += " " + number_word(gcode::axis_letters[n], state.tool_offset[n]);
        }
    }
    return words.empty() ? "G49\n" : "G43.1" + words + "\n";
}

} // namespace

std::string number_word(char letter, double value) {
    constexpr program::NumberFormat format{.decimals = 6, .trailing_zeros = false, .point = false};
    return letter + format.text(value);
}

std::string modal_lines(const ModalState& state, Dialect dialect) {
    const bool linuxcnc = dialect == Dialect::linuxcnc;
    std::string text = state.unit == LengthUnit::mm ? "G21\n" : "G20\n";
    text += fmt::format("{}\nG40\n", plane_code(state.plane));
    text += work_system_name(state.coordinate_system) + "\n";
    text += tool_offset(state);
    if (linuxcnc) {
        text += path_code(state);
        text += state.arc_distance == gcode::DistanceMode::absolute ? "G90.1\n" : "G91.1\n";
        text += state.diameter_mode ? "G7\n" : "G8\n";
        text += state.cycle_return == gcode::CycleReturn::r_level ? "G99\n" : "G98\n";
    }
    text += fmt::format("{}\n", feed_code(state.feed_mode));
    if (state.feed_rate > 0.0 && state.feed_mode != FeedMode::inverse_time) {
        text += number_word('F', state.feed_rate) + "\n";
    }
    if (state.spindle_speed > 0.0 && state.spindle_mode == gcode::SpindleMode::constant_speed) {
        text += number_word('S', state.spindle_speed) + "\n";
    }
    return text + (state.distance == gcode::DistanceMode::incremental ? "G91\n" : "G90\n");
}

} // namespace millwright::drivers
