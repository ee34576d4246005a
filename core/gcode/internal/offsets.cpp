#include "core/gcode/internal/offsets.h"

#include "core/base/numbers.h"
#include "core/base/units.h"
#include "core/gcode/internal/codes.h"
#include "core/gcode/internal/refusal.h"
#include "core/gcode/internal/targets.h"

#include <fmt/format.h>

#include <cmath>

namespace millwright::gcode::internal {

namespace {

void forbid_with_compensation(const Run& run, const Block& block, std::string_view what) {
    if (run.state.cutter.on()) {
        refuse(block.column_of(GGroup::non_modal), fmt::format("{} while cutter compensation is on", what));
    }
}

/// The position without offsets of coordinate system and G92, and with the tool's length.
AxisValues without_systems(const ModalState& state) {
    return rotated(state.position + state.g92_offset, state.rotation_deg) + state.g5x_offset;
}

AxisValues in_system(const AxisValues& bare, const AxisValues& g5x, double rotation, const AxisValues& g92) {
    return rotated(bare - g5x, -rotation) - g92;
}

AxisBits axes_given(const Block& block) {
    AxisBits axes = 0;
    for (std::size_t n = 0; n < axis_count; ++n) {
        axes |= block.has(axis_letters[n]) ? static_cast<AxisBits>(1U << n) : AxisBits{};
    }
    return axes;
}

/// The axes that have a word take something from where they are.
void send_measured(Run& run, const Block& block, int code) {
    Command measured = command_of(CommandKind::measure_position, code);
    measured.mode = axes_given(block);
    run.out.send(measured);
}

AxisValues given_axes(const Block& block, AxisValues otherwise) {
    for (std::size_t n = 0; n < axis_count; ++n) {
        otherwise[n] = block.value_or(axis_letters[n], otherwise[n]);
    }
    return otherwise;
}

} // namespace

void send_system(Run& run) {
    const int system = run.state.coordinate_system;
    Command selected = command_of(CommandKind::set_g5x_offset, run.state.g5x_offset, system);
    selected.mode = run.variables.axes_set(parameter_g5x(system));
    run.out.send(selected);
}

void send_rotation(Run& run) {
    const bool known = run.variables.is_set(parameter_g5x(run.state.coordinate_system) + 9);
    run.out.send(CommandKind::set_xy_rotation, known ? 1 : 0, run.state.rotation_deg);
}

void send_g92(Run& run) {
    Command offset = command_of(CommandKind::set_g92_offset, run.state.g92_offset);
    offset.mode = run.g92_known;
    run.out.send(offset);
}

AxisValues rotated(AxisValues values, double degrees) {
    if (exactly_equal(degrees, 0.0)) {
        return values;
    }
    const double t = from_degrees(degrees);
    const double x = values[Axis::x];
    const double y = values[Axis::y];
    values[Axis::x] = x * std::cos(t) - y * std::sin(t);
    values[Axis::y] = x * std::sin(t) + y * std::cos(t);
    return values;
}

AxisValues relative_to_system(const AxisValues& machine, const ModalState& state) {
    AxisValues length = state.tool_offset;
    for (const Axis rotary : {Axis::a, Axis::b, Axis::c}) {
        length[rotary] = 0.0;
    }
    return in_system(machine - length, state.g5x_offset, state.rotation_deg, state.g92_offset);
}

void set_units(Run& run, int code) {
    ModalState& s = run.state;
    const LengthUnit unit = code == 200 ? LengthUnit::inch : LengthUnit::mm;
    run.out.send(CommandKind::use_length_units, static_cast<int>(unit));
    if (s.unit == unit) {
        return;
    }
    const double factor = unit == LengthUnit::mm ? mm_per_inch : 1.0 / mm_per_inch;
    s.unit = unit;
    for (AxisValues* values : {&s.position, &s.programmed, &s.g5x_offset, &s.g92_offset, &s.tool_offset}) {
        *values = values->lengths_scaled(factor);
    }
    s.feed_rate *= s.feed_mode == FeedMode::inverse_time ? 1.0 : factor;
    s.path_tolerance *= factor;
    s.naivecam_tolerance *= factor;
    s.cutter.radius *= factor;
    run.compensated_begin *= factor;
    run.flushed_to *= factor;
    for (Waiting& waiting : run.out.waiting()) {
        waiting.move.target = waiting.move.target.lengths_scaled(factor);
        waiting.move.centre_1 *= factor;
        waiting.move.centre_2 *= factor;
    }
}

void select_coordinate_system(Run& run, int code) {
    ModalState& s = run.state;
    if (s.cutter.on()) {
        refuse(1, "the coordinate system cannot change while cutter compensation is on");
    }
    const int system = code < 590 ? (code - 530) / 10 : code - 590 + 6;
    if (system == s.coordinate_system) {
        run.out.post(
            command_of(CommandKind::comment, "interpreter: continuing to use same coordinate system"));
        return;
    }
    const AxisValues bare = without_systems(s);
    s.coordinate_system = system;
    run.variables.set(parameter_system, system);
    s.g5x_offset = run.to_program(run.variables.axes_from(parameter_g5x(system)));
    s.rotation_deg = run.variables.stored(parameter_g5x(system) + 9);
    s.position = in_system(bare, s.g5x_offset, s.rotation_deg, s.g92_offset);
    send_system(run);
    send_g92(run);
    send_rotation(run);
}

void set_tool_length(Run& run, const Block& block, int code) {
    ModalState& s = run.state;
    if (s.cutter.on()) {
        refuse(block.column_of(GGroup::tool_length),
               "the tool offset cannot change while cutter compensation is on");
    }
    constexpr int g43_4 = 434;
    if (run.settings.dialect == Dialect::fanuc) {
        run.out.send(CommandKind::control_tip, code == g43_4 ? 1 : 0);
    }
    if (code == g43_4) {
        return; // the tool's length is the control's affair
    }
    const auto offset_of_h = [&] {
        const int number = static_cast<int>(block['H']);
        const int row = run.row_of_tool(number);
        if (row < 0) {
            refuse(block.column_of('H'), fmt::format("tool {} is not in the tool table", number));
        }
        return run.to_program(row == 0 ? s.spindle_tool.offset : run.tools.at_row(row).offset);
    };
    AxisValues offset;
    if (code == 430) {
        offset = block.has('H') ? offset_of_h() : run.to_program(s.spindle_tool.offset);
    } else if (code == 431) {
        offset = given_axes(block, s.tool_offset);
    } else if (code == 432) {
        if (!block.has('H') && !block.has_any(axis_words)) {
            refuse(block.column_of(GGroup::tool_length), "G43.2 needs a tool, H, or axis words");
        }
        offset = s.tool_offset + (block.has('H') ? offset_of_h() : given_axes(block, {}));
    }
    run.out.send(command_of(CommandKind::use_tool_length_offset, offset));
    s.position += rotated(s.tool_offset - offset, -s.rotation_deg);
    s.tool_offset = offset;
    s.length_tool = code != 430 ? 0 : block.has('H') ? static_cast<int>(block['H']) : s.spindle_tool.number;
}

void set_axis_offsets(Run& run, const Block& block, int code) {
    ModalState& s = run.state;
    forbid_with_compensation(run, block, "axis offsets cannot change");
    const AxisValues before = s.g92_offset;
    AxisValues offset;
    if (code == 923) {
        run.g92_known = run.variables.axes_set(parameter_g92);
    } else if (code == 520) {
        run.g92_known |= axes_given(block);
    } else if (code != 920) { // G92 counts from where the axes are, which is as certain as before
        run.g92_known = every_axis;
    }
    if (code == 920) {
        send_measured(run, block, code);
        offset = before + s.position - given_axes(block, s.position);
    } else if (code == 520) {
        offset = given_axes(block, before);
    } else if (code == 923) {
        offset = run.to_program(run.variables.axes_from(parameter_g92));
    }
    s.position += before - offset;
    s.g92_offset = offset;
    send_g92(run);
    run.variables.set(parameter_g92_active, code == 921 || code == 922 ? 0.0 : 1.0);
    if (code == 920 || code == 520 || code == 921) {
        run.variables.set_axes(parameter_g92, run.to_machine(offset), every_axis, run.g92_known);
    }
}

// ---- G10

namespace {

constexpr int g10 = 100; // in tenths

/// The position in `system` of the point of the machine that the tool's length is measured from.
AxisValues without_tool_length(const Run& run, int system, bool with_g92) {
    const ModalState& s = run.state;
    const int first = parameter_g5x(system);
    return in_system(without_systems(s) + s.tool_offset,
                     run.to_program(run.variables.axes_from(first)),
                     run.variables.stored(first + 9),
                     with_g92 ? s.g92_offset : AxisValues{});
}

/// The offset that makes the present position the given one. An axis that is not given keeps its offset; of a
/// rotated system, along the rotated axes.
AxisValues touched_off(const Run& run, const Block& block, const AxisValues& old_offset) {
    const bool to_fixture = static_cast<int>(block['L']) == 11;
    constexpr int fixture_system = 9; // G59.3
    const int system = to_fixture ? fixture_system : run.state.coordinate_system;
    const double rotation = run.variables.stored(parameter_g5x(system) + 9);
    const AxisValues here = without_tool_length(run, system, !to_fixture);
    AxisValues offset = rotated(old_offset, -rotation);
    for (std::size_t n = 0; n < axis_count; ++n) {
        if (block.has(axis_letters[n])) {
            offset[n] = here[n] - block[axis_letters[n]];
        }
    }
    return rotated(offset, rotation);
}

void set_tool_data(Run& run, const Block& block) {
    const int number = static_cast<int>(std::round(block['P']));
    const int row = run.row_of_tool(number);
    if (row < 0) {
        refuse(block.column_of('P'), fmt::format("tool {} is not in the tool table", number));
    }
    if (!block.has_any(axis_words | words_of("RIJQ"))) {
        refuse(block.column_of(GGroup::non_modal), "G10 L1 needs at least one offset");
    }
    Tool& tool = run.tools.at_row(row);
    const AxisValues old_offset = run.to_program(tool.offset);
    if (static_cast<int>(block['L']) != 1) {
        send_measured(run, block, g10);
    }
    tool.offset = run.to_machine(static_cast<int>(block['L']) == 1 ? given_axes(block, old_offset)
                                                                   : touched_off(run, block, old_offset));
    tool.unknown &= static_cast<std::uint16_t>(~(axes_given(block) << 1U));
    constexpr std::string_view words = "RIJQ"; // of parameters #5410 to #5413
    for (std::size_t n = 0; n < words.size(); ++n) {
        tool.unknown &= static_cast<std::uint16_t>(block.has(words[n]) ? ~(1U << (10U + n)) : ~0U);
    }
    if (block.has('R')) {
        tool.diameter = 2.0 * block['R'] / run.machine_to_program();
    }
    tool.front_angle = block.value_or('I', tool.front_angle);
    tool.back_angle = block.value_or('J', tool.back_angle);
    if (block.has('Q')) {
        const double q = block['Q'];
        if (!(q >= 0.0 && q <= 9.0) || std::abs(q - std::round(q)) > 1e-4) {
            refuse(block.column_of('Q'), "Q of G10 is a tool orientation and must be 0 to 9");
        }
        tool.orientation = static_cast<int>(std::round(q));
    }
    Command entry = command_of(CommandKind::set_tool_table_entry, row);
    entry.tool = tool;
    run.out.send(entry);
    if (run.state.row_in_spindle == row) {
        run.state.spindle_tool = tool;
        entry.index = 0;
        run.out.send(entry);
    }
}

void set_system_data(Run& run, const Block& block) {
    ModalState& s = run.state;
    const bool relative = static_cast<int>(block['L']) == 20;
    const int given = static_cast<int>(std::round(block['P']));
    const int system = given == 0 ? s.coordinate_system : given;
    const bool active = system == s.coordinate_system;
    if (block.has_any(words_of("IJ"))) {
        refuse(block.column_of(block.has('I') ? 'I' : 'J'), "G10 L2 does not accept I or J");
    }
    if (relative && block.has('R')) {
        refuse(block.column_of('R'), "G10 L20 does not accept R");
    }
    if (active) {
        forbid_with_compensation(run, block, "the active coordinate system cannot change");
    }
    const int first = parameter_g5x(system);
    const double rotation = block.value_or('R', run.variables.stored(first + 9));
    const AxisValues old_offset = run.to_program(run.variables.axes_from(first));
    const AxisValues bare = without_systems(s);
    AxisValues offset = given_axes(block, old_offset);
    if (relative) {
        send_measured(run, block, g10);
        const AxisValues here = in_system(bare, old_offset, rotation, s.g92_offset);
        offset = old_offset + rotated(here - given_axes(block, here), rotation);
    }
    if (block.has('R')) {
        run.variables.set(first + 9, rotation);
    }
    run.variables.set_axes(
        first, run.to_machine(offset), axes_given(block), relative ? run.placed_axes() : every_axis);
    if (!active) {
        run.out.post(command_of(CommandKind::comment, "interpreter: setting coordinate system origin"));
        return;
    }
    // LinuxCNC turns the position without its G92 offset here, which shows when the rotation changes.
    s.position = rotated(rotated(s.position, s.rotation_deg) + s.g5x_offset - offset, -rotation);
    s.g5x_offset = offset;
    s.rotation_deg = rotation;
    send_system(run);
    send_rotation(run);
}

} // namespace

void set_coordinate_data(Run& run, const Block& block) {
    const int kind = static_cast<int>(block['L']);
    if (kind == 2 || kind == 20) {
        set_system_data(run, block);
    } else {
        set_tool_data(run, block);
    }
}

// ---- reference points

void go_to_reference(Run& run, const Block& block, int code) {
    ModalState& s = run.state;
    forbid_with_compensation(run, block, fmt::format("{} cannot be used", g_name(code)));
    Move move = run.out.new_move(MoveKind::traverse);
    move.target = end_of_move(block, s);
    run.out.send(move);
    const int stored = code == 280 ? parameter_g28 : parameter_g30;
    const AxisValues reference = relative_to_system(run.to_program(run.variables.axes_from(stored)), s);
    const bool all = !block.has_any(axis_words);
    for (std::size_t n = 0; n < axis_count; ++n) {
        if (all || block.has(axis_letters[n])) {
            move.target[n] = reference[n];
            move.words.named |= static_cast<AxisBits>(1U << n);
        }
    }
    move.words.frame = code == 280 ? MoveFrame::reference : MoveFrame::reference_2;
    move.words.incremental = false;
    move.words.reference_set = run.variables.axes_set(stored);
    run.out.send(move);
    s.position = move.target;
}

void set_reference(Run& run, int code) {
    const ModalState& s = run.state;
    if (s.cutter.on()) {
        refuse(1, "the reference point cannot be set while cutter compensation is on");
    }
    Command measured = command_of(CommandKind::measure_position, code);
    measured.mode = every_axis;
    run.out.send(measured);
    const AxisValues machine = without_systems(s) + s.tool_offset;
    run.variables.set_axes(
        code == 281 ? parameter_g28 : parameter_g30, run.to_machine(machine), every_axis, run.placed_axes());
}

void reset_coordinate_system(Run& run) {
    ModalState& s = run.state;
    const AxisValues bare = without_systems(s);
    s.coordinate_system = 1;
    run.variables.set(parameter_system, 1.0);
    s.g5x_offset = run.to_program(run.variables.axes_from(parameter_g5x(1)));
    s.rotation_deg = run.variables.stored(parameter_g5x(1) + 9);
    s.position = in_system(bare, s.g5x_offset, s.rotation_deg, s.g92_offset);
    send_system(run);
    send_rotation(run);
}

} // namespace millwright::gcode::internal
