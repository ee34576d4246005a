#include "core/gcode_programs/internal/unsupported_features.h"

#include "core/gcode/word_column.h"
#include "core/gcode_programs/placement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::gcode::internal {

Diagnostic at_word(const std::filesystem::path& file,
                   SourcePlace source,
                   std::string_view line,
                   char letter,
                   std::string message) {
    const int word = letter == '\0' ? 0 : column_of_word(line, letter);
    return {
        {file, source.line, word > 0 ? word : std::max(first_column(line), 1), -1}, std::move(message), {}};
}

namespace {

bool is_zero(const AxisValues& values) {
    for (std::size_t n = 0; n < axis_count; ++n) {
        if (std::abs(values[n]) > 0.0) {
            return false;
        }
    }
    return true;
}

} // namespace

void UnsupportedFeatures::note(
    Kind kind, SourcePlace source, std::string_view line, char letter, const std::string& message) {
    std::vector<Diagnostic>& all = kind == Kind::lost ? lost_ : simplified_;
    if (std::ranges::find(all, message, &Diagnostic::message) == all.end()) {
        all.push_back(at_word(file_, source, line, letter, message));
    }
}

void UnsupportedFeatures::move(const Move& move, std::string_view line) {
    if (move.kind == MoveKind::probe) {
        note(Kind::lost,
             move.source,
             line,
             'G',
             "probing (G38) is not possible in a motion that is planned in advance");
    }
}

void UnsupportedFeatures::command(const Command& command, std::string_view line) {
    const auto lose = [&](char letter, const char* why) {
        note(Kind::lost, command.source, line, letter, why);
    };
    const auto simplify = [&](char letter, const char* how) {
        note(Kind::simplified, command.source, line, letter, how);
    };
    switch (command.kind) {
    case CommandKind::start_speed_feed_synch:
        return lose('G', "spindle-synchronized feed is not possible here (G33, G33.1, G76)");
    case CommandKind::set_spindle_mode:
        return command.value > 0.0 ? lose('G', "constant surface speed is not possible here (G96)") : void();
    case CommandKind::wait_input:
        return lose('M', "inputs are not waited for here (M66)");
    case CommandKind::mist_on:
        return simplify('M', "mist coolant (M7) is treated as flood (M8)");
    case CommandKind::orient_spindle:
        return simplify('M', "the spindle is not oriented (M19)");
    case CommandKind::set_motion_output_bit:
    case CommandKind::clear_motion_output_bit:
    case CommandKind::set_aux_output_bit:
    case CommandKind::clear_aux_output_bit:
    case CommandKind::set_motion_output_value:
    case CommandKind::set_aux_output_value:
        return simplify('M', "outputs are not switched (M62 to M65, M67, M68)");
    case CommandKind::user_command:
        return simplify('M', "user-defined commands are ignored (M100 to M199)");
    case CommandKind::disable_feed_override:
    case CommandKind::disable_speed_override:
    case CommandKind::enable_adaptive_feed:
    case CommandKind::disable_feed_hold:
        return simplify('M', "overrides and feed hold remain enabled (M49 to M53, G74, G84)");
    case CommandKind::use_tool_length_offset:
        if (is_zero(command.axes) && line.find_first_of("Hh") != std::string_view::npos) {
            simplify('H',
                     "the tool length is unknown, so the length offset of G43 is taken as 0: give the tool "
                     "lengths with a tool table (--tools)");
        }
        return;
    case CommandKind::set_g5x_offset:
        if (command.index > 1 && command.mode == 0 && is_zero(command.axes)) {
            note(Kind::simplified,
                 command.source,
                 line,
                 'G',
                 fmt::format("the offset of {} is unknown and is taken as 0", name_of_system(command.index)));
        }
        return;
    default:
        return;
    }
}

} // namespace millwright::gcode::internal
