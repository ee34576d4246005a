#include "core/gcode/internal/machine_codes.h"

#include "core/base/numbers.h"
#include "core/gcode/internal/compensation_lookahead.h"
#include "core/gcode/internal/offsets.h"
#include "core/gcode/internal/refusal.h"
#include "core/gcode/internal/saved_modes.h"

#include <fmt/format.h>

#include <cmath>

namespace millwright::gcode::internal {

namespace {

constexpr double unlimited_rpm = 1e30; // LinuxCNC's word for no limit in G96

void forbid_m_code_with_compensation(const Run& run, const Block& block, MGroup group) {
    if (run.state.cutter.on()) {
        refuse(block.column_of(group),
               fmt::format("M{} cannot be used while cutter compensation is on", block.code(group)));
    }
}

// ---- M62 to M68

int channel(const Block& block, char letter, int code) {
    const double value = block.value_or(letter, -1.0);
    const int whole = static_cast<int>(std::round(value));
    if (!block.has(letter) || value < 0.0 || std::abs(value - whole) > 1e-4) {
        refuse(block.column_of(letter), fmt::format("M{} needs an integer channel number {}", code, letter));
    }
    return whole;
}

void wait_for_input(Run& run, const Block& block) {
    const int mode = static_cast<int>(block.value_or('L', 0.0));
    const double timeout = block.value_or('Q', 0.0);
    if (block.has('P') && block.has('E')) {
        refuse(block.column_of('E'), "M66 needs either a digital input, P, or an analog input, E, not both");
    }
    const bool analog = block.has('E');
    Command wait = command_of(CommandKind::wait_input, channel(block, analog ? 'E' : 'P', 66));
    if (mode > 4) {
        refuse(block.column_of('L'), "L of M66 must be 0 to 4");
    }
    if (mode > 0 && !(timeout > 0.0)) {
        refuse(block.column_of('L'), "M66 with a wait mode needs a timeout, Q");
    }
    if (mode > 0 && analog) {
        refuse(block.column_of('L'), "M66 can only read an analog input immediately: use L0");
    }
    constexpr int analog_mode = 5;
    wait.mode = analog ? analog_mode : mode;
    wait.value = timeout;
    run.out.send(wait);
    run.variables.set(parameter_input, 0.0); // there is no input here
}

void execute_input_output(Run& run, const Block& block, int code) {
    forbid_m_code_with_compensation(run, block, MGroup::input_output);
    if (code == 66) {
        wait_for_input(run, block);
        return;
    }
    const bool analog = code == 67 || code == 68;
    static constexpr std::array<CommandKind, 7> kinds{CommandKind::set_motion_output_bit,
                                                      CommandKind::clear_motion_output_bit,
                                                      CommandKind::set_aux_output_bit,
                                                      CommandKind::clear_aux_output_bit,
                                                      CommandKind::wait_input,
                                                      CommandKind::set_motion_output_value,
                                                      CommandKind::set_aux_output_value};
    const double value = analog ? block.value_or('Q', 0.0) : 0.0;
    run.out.send(kinds[static_cast<std::size_t>(code - 62)], channel(block, analog ? 'E' : 'P', code), value);
}

// ---- tools

void load(Run& run, int row) {
    run.state.row_in_spindle = row;
    run.state.spindle_tool = row == 0 ? Tool{} : run.tools.at_row(row);
}

void change_tool(Run& run, const Block& block) {
    forbid_m_code_with_compensation(run, block, MGroup::tool_change);
    run.out.post(CommandKind::start_change);
    run.out.send(CommandKind::stop_spindle_turning);
    run.state.spindle = SpindleTurning::stopped;
    run.out.send(CommandKind::change_tool, run.state.selected_row);
    load(run, run.state.selected_row);
}

void set_tool_number(Run& run, const Block& block) {
    const double q = block.value_or('Q', -1.0);
    const int number = static_cast<int>(std::round(q));
    if (q < 0.0 || std::abs(q - number) > 1e-4) {
        refuse(block.column_of('Q'), "M61 needs a tool number, Q");
    }
    const int row = run.row_of_tool(number);
    if (row < 0) {
        refuse(block.column_of('Q'), fmt::format("tool {} is not in the tool table", number));
    }
    run.out.send(CommandKind::change_tool_number, row);
    load(run, row);
}

// ---- spindle, coolant, overrides

void orient_spindle(Run& run, const Block& block) {
    run.state.spindle = SpindleTurning::stopped;
    if (block.has_any(words_of("RP"))) {
        run.out.post(command_of(CommandKind::orient_spindle,
                                static_cast<int>(std::round(block.value_or('P', 0.0))),
                                block.value_or('R', 0.0)));
    }
    if (block.has('Q')) {
        if (!(block['Q'] > 0.0)) {
            refuse(block.column_of('Q'), "Q of M19 must be greater than 0");
        }
        run.out.post(CommandKind::wait_spindle_orient, 0, block['Q']);
    }
}

void execute_spindle(Run& run, const Block& block, int code) {
    ModalState& s = run.state;
    switch (code) {
    case 3:
        run.out.post(CommandKind::start_spindle_clockwise);
        s.spindle = SpindleTurning::clockwise;
        break;
    case 4:
        run.out.post(CommandKind::start_spindle_counterclockwise);
        s.spindle = SpindleTurning::counterclockwise;
        break;
    case 5:
        run.out.post(CommandKind::stop_spindle_turning);
        s.spindle = SpindleTurning::stopped;
        break;
    case 19:
        orient_spindle(run, block);
        break;
    default:
        execute_saved_modes(run, block, code);
        break;
    }
}

void execute_coolant(Run& run, int code) {
    ModalState& s = run.state;
    if (code == 7) {
        run.out.post(CommandKind::mist_on);
        s.mist = true;
    } else if (code == 8) {
        run.out.post(CommandKind::flood_on);
        s.flood = true;
    } else {
        run.out.post(CommandKind::mist_off);
        run.out.post(CommandKind::flood_off);
        s.mist = s.flood = false;
    }
}

void set_feed_override(Run& run, bool on) {
    run.out.send(on ? CommandKind::enable_feed_override : CommandKind::disable_feed_override);
    run.state.overrides.feed = run.feed_override_enabled = on;
}

void set_speed_override(Run& run, bool on) {
    run.out.send(on ? CommandKind::enable_speed_override : CommandKind::disable_speed_override);
    run.state.overrides.speed = on;
}

void execute_override(Run& run, const Block& block, int code) {
    forbid_m_code_with_compensation(run, block, MGroup::overrides);
    const bool on = code == 48 || (code != 49 && !exactly_equal(block.value_or('P', 1.0), 0.0));
    if (code == 48 || code == 49 || code == 50) {
        set_feed_override(run, on);
    }
    if (code == 48 || code == 49 || code == 51) {
        set_speed_override(run, on);
    }
    if (code == 52) {
        run.out.send(on ? CommandKind::enable_adaptive_feed : CommandKind::disable_adaptive_feed);
        run.state.overrides.adaptive_feed = on;
    }
    if (code == 53) {
        run.out.send(on ? CommandKind::enable_feed_hold : CommandKind::disable_feed_hold);
        run.state.overrides.feed_hold = on;
    }
}

void execute_user_code(Run& run, const Block& block, int code) {
    Command user = command_of(CommandKind::user_command, code, block.value_or('P', -1.0));
    user.value_2 = block.value_or('Q', -1.0);
    run.out.post(user);
}

} // namespace

void end_program(Run& run, bool shuttle) {
    ModalState& s = run.state;
    reset_coordinate_system(run);
    if (s.plane != Plane::xy) {
        s.plane = Plane::xy;
        run.out.send(CommandKind::select_plane, static_cast<int>(s.plane));
    }
    s.distance = DistanceMode::absolute;
    s.feed_mode = FeedMode::per_minute;
    run.out.send(CommandKind::set_feed_mode);
    s.feed_rate = 0.0;
    run.out.send(CommandKind::set_feed_rate);
    if (!s.overrides.feed) {
        set_feed_override(run, true);
    }
    // The speed override stays as it is: LinuxCNC 2.9 does not switch it on again.
    s.cutter = {};
    run.out.send(CommandKind::stop_spindle_turning);
    s.spindle = SpindleTurning::stopped;
    run.out.send(CommandKind::set_spindle_mode);
    constexpr int g1 = 10;
    s.motion = g1;
    if (s.mist) {
        run.out.send(CommandKind::mist_off);
    }
    if (s.flood) {
        run.out.send(CommandKind::flood_off);
    }
    s.mist = s.flood = false;
    if (shuttle) {
        run.out.send(CommandKind::pallet_shuttle);
    }
    run.out.send(CommandKind::program_end);
    run.ended = true;
}

int Run::row_of_tool(int number) {
    constexpr std::size_t most_tools = 10'000;
    const int row = number == 0 ? 0 : tools.row_of(number);
    if (row >= 0 || !settings.any_tool || tools.tools.size() >= most_tools) {
        return row;
    }
    Tool tool;
    tool.number = number;
    tool.unknown = tool_unknown_but_number;
    tools.tools.push_back(tool);
    return static_cast<int>(tools.tools.size());
}

void set_spindle_mode(Run& run, const Block& block, int code) {
    const bool constant_surface = code == 960;
    run.state.spindle_mode =
        constant_surface ? SpindleMode::constant_surface_speed : SpindleMode::constant_speed;
    const double limit = block.has('D') ? std::abs(block['D']) : unlimited_rpm;
    run.out.post(CommandKind::set_spindle_mode, 0, constant_surface ? limit : 0.0);
}

void set_feed_mode(Run& run, int code) {
    ModalState& s = run.state;
    if (run.settings.dialect == Dialect::grbl && code == 940 && s.feed_mode == FeedMode::per_minute) {
        return; // LinuxCNC forgets the feed here, Grbl only when the mode changes
    }
    if (code == 930) {
        run.out.post(command_of(CommandKind::comment, "interpreter: feed mode set to inverse time"));
        s.feed_mode = FeedMode::inverse_time;
        run.out.post(CommandKind::set_feed_mode);
        return;
    }
    const bool per_revolution = code == 950;
    run.out.post(command_of(CommandKind::comment,
                            per_revolution ? "interpreter: feed mode set to units per revolution"
                                           : "interpreter: feed mode set to units per minute"));
    s.feed_mode = per_revolution ? FeedMode::per_revolution : FeedMode::per_minute;
    run.out.post(CommandKind::set_feed_mode, per_revolution ? 1 : 0);
    s.feed_rate = 0.0;
    run.out.post(CommandKind::set_feed_rate);
}

void set_feed_rate(Run& run, double rate) {
    run.state.feed_rate = rate;
    run.out.post(CommandKind::set_feed_rate, 0, rate);
}

void set_spindle_speed(Run& run, double speed) {
    run.state.spindle_speed = speed;
    run.out.post(CommandKind::set_spindle_speed, 0, speed);
}

void select_tool(Run& run, const Block& block) {
    const int number = static_cast<int>(block['T']);
    const int row = run.row_of_tool(number);
    if (row < 0) {
        refuse(block.column_of('T'), fmt::format("tool {} is not in the tool table", number));
    }
    run.out.send(CommandKind::select_tool, number);
    run.state.selected_tool = number;
    run.state.selected_row = row;
}

void execute_m_codes(Run& run, const Block& block) {
    if (const int code = block.code(MGroup::input_output); code != no_code) {
        execute_input_output(run, block, code);
    }
    if (const int code = block.code(MGroup::tool_change); code == 6) {
        change_tool(run, block);
    } else if (code != no_code) {
        set_tool_number(run, block);
    }
    if (const int code = block.code(MGroup::spindle); code != no_code) {
        execute_spindle(run, block, code);
    }
    if (const int code = block.code(MGroup::coolant); code != no_code) {
        execute_coolant(run, code);
    }
    if (const int code = block.code(MGroup::overrides); code != no_code) {
        execute_override(run, block, code);
    }
    if (const int code = block.code(MGroup::user); code != no_code) {
        execute_user_code(run, block, code);
    }
}

void execute_stop(Run& run, const Block&, int code) {
    finish_waiting(run);
    switch (code) {
    case 0:
        run.out.send(CommandKind::program_stop);
        break;
    case 60:
        run.out.send(CommandKind::pallet_shuttle);
        run.out.send(CommandKind::program_stop);
        break;
    case 1:
        run.out.send(CommandKind::optional_program_stop);
        break;
    default:
        end_program(run, code == 30);
        break;
    }
}

} // namespace millwright::gcode::internal
