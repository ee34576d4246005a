#include "core/gcode/internal/execute.h"

#include "core/gcode/internal/codes.h"
#include "core/gcode/internal/comments.h"
#include "core/gcode/internal/compensation.h"
#include "core/gcode/internal/grbl_rules.h"
#include "core/gcode/internal/machine_codes.h"
#include "core/gcode/internal/motions.h"
#include "core/gcode/internal/offsets.h"
#include "core/gcode/internal/path_modes.h"
#include "core/gcode/internal/refusal.h"
#include "core/gcode/internal/word_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace millwright::gcode::internal {

namespace {

void set_parameters(Run& run, const std::vector<Assignment>& assignments) {
    for (const Assignment& assignment : assignments) {
        if (assignment.number > 0) {
            run.variables.set(assignment.number, assignment.value);
        } else {
            run.variables.set(assignment.name, assignment.value);
        }
    }
}

void say(Run& run, std::string_view what) {
    run.out.post(command_of(CommandKind::comment, what));
}

void set_plane(Run& run, const Block& block, int code) {
    Plane plane = Plane::xy;
    switch (code) {
    case 180:
        plane = Plane::xz;
        break;
    case 190:
        plane = Plane::yz;
        break;
    case 171:
        plane = Plane::uv;
        break;
    case 181:
        plane = Plane::uw;
        break;
    case 191:
        plane = Plane::vw;
        break;
    default:
        break;
    }
    if (run.state.cutter.on() && plane != run.state.plane) {
        refuse(block.column_of(GGroup::plane), "the plane cannot change while cutter compensation is on");
    }
    run.out.send(CommandKind::select_plane, static_cast<int>(plane));
    run.state.plane = plane;
}

void set_distance(Run& run, int code) {
    const DistanceMode wanted = code == 910 ? DistanceMode::incremental : DistanceMode::absolute;
    if (wanted != run.state.distance) {
        say(run,
            wanted == DistanceMode::incremental ? "interpreter: distance mode changed to incremental"
                                                : "interpreter: distance mode changed to absolute");
        run.state.distance = wanted;
    }
}

void set_arc_distance(Run& run, int code) {
    const DistanceMode wanted = code == 901 ? DistanceMode::absolute : DistanceMode::incremental;
    if (wanted != run.state.arc_distance) {
        say(run,
            wanted == DistanceMode::absolute ? "interpreter: IJK distance mode changed to absolute"
                                             : "interpreter: IJK distance mode changed to incremental");
        run.state.arc_distance = wanted;
    }
}

void set_diameter_mode(Run& run, int code) {
    const bool diameter = code == 70;
    if (diameter != run.state.diameter_mode) {
        run.out.send(command_of(CommandKind::comment,
                                diameter ? "interpreter: Lathe diameter mode changed to diameter"
                                         : "interpreter: Lathe diameter mode changed to radius"));
        run.state.diameter_mode = diameter;
    }
}

void set_compensation(Run& run, const Block& block, int code) {
    if (code == 400) {
        stop_compensation(run);
    } else {
        start_compensation(run, block, code);
    }
}

void set_retract(Run& run, const Block& block, int code) {
    if (run.state.cutter.on()) {
        refuse(block.column_of(GGroup::retract),
               "the retract mode cannot change while cutter compensation is on");
    }
    const bool to_r = code == 990;
    say(run, to_r ? "interpreter: retract mode set to r_plane" : "interpreter: retract mode set to old_z");
    run.state.cycle_return = to_r ? CycleReturn::r_level : CycleReturn::initial_level;
}

void execute_non_modal(Run& run, const Block& block, int code) {
    switch (code) {
    case 53:
        make_nurbs(run, block);
        break;
    case 100:
        set_coordinate_data(run, block);
        break;
    case 280:
    case 300:
        go_to_reference(run, block, code);
        break;
    case 281:
    case 301:
        set_reference(run, code);
        break;
    case 520:
    case 920:
    case 921:
    case 922:
    case 923:
        set_axis_offsets(run, block, code);
        break;
    default: // G4 was executed, G53 belongs to the motion
        break;
    }
}

void execute_motion(Run& run, Block& block, int motion) {
    const bool cycle = is_drilling_cycle(motion);
    if (!cycle) {
        run.state.cycle.initial_level_set = false;
    }
    if (motion == 0 || motion == 10) {
        run.after_spline = false;
        make_straight(run, block, motion);
        return;
    }
    run.after_spline = run.after_spline && motion == 50;
    switch (motion) {
    case 20:
    case 30:
        make_arc(run, block, motion);
        break;
    case 50:
    case 51:
        make_spline(run, block, motion);
        break;
    case 52:
        add_nurbs_point(run, block);
        break;
    case 330:
    case 331:
        make_synchronised(run, block, motion);
        break;
    case 382:
    case 383:
    case 384:
    case 385:
        make_probe(run, block, motion);
        break;
    case 760:
        make_threading(run, block);
        break;
    case 800:
        say(run, "interpreter: motion mode set to none");
        run.state.motion = motion;
        break;
    default:
        make_cycle(run, block, motion);
        break;
    }
}

/// G7: X words are diameters.
void apply_diameter_mode(const ModalState& s, Block& block) {
    if (s.diameter_mode && block.has('X')) {
        block.value['X' - 'A'] *= 0.5;
    }
}

/// Grbl reads F in the unit that its line sets, LinuxCNC in the one before.
bool feed_waits_for_unit(const Run& run, const Block& block) {
    return run.settings.dialect == Dialect::grbl && block.code(GGroup::units) != no_code;
}

void take_feed(Run& run, const Block& block) {
    if (block.has('F') && run.state.feed_mode != FeedMode::inverse_time) {
        set_feed_rate(run, block['F']);
    }
}

void change_units(Run& run, const Block& block, int code) {
    set_units(run, code);
    if (feed_waits_for_unit(run, block)) {
        take_feed(run, block);
    }
}

struct BlockStep {
    GGroup group;
    void (*execute)(Run& run, const Block& block, int code);
};

// In LinuxCNC's order.
constexpr std::array<BlockStep, 11> steps{{
    {GGroup::plane, set_plane},
    {GGroup::units, change_units},
    {GGroup::lathe_diameter, [](Run& run, const Block&, int code) { set_diameter_mode(run, code); }},
    {GGroup::cutter_compensation, set_compensation},
    {GGroup::tool_length, set_tool_length},
    {GGroup::coordinate_system,
     [](Run& run, const Block&, int code) { select_coordinate_system(run, code); }},
    {GGroup::path_control, set_path_mode},
    {GGroup::distance, [](Run& run, const Block&, int code) { set_distance(run, code); }},
    {GGroup::arc_distance, [](Run& run, const Block&, int code) { set_arc_distance(run, code); }},
    {GGroup::retract, set_retract},
    {GGroup::non_modal, execute_non_modal},
}};

void execute_g_codes(Run& run, Block& block) {
    constexpr int dwell = 40;
    if (block.code(GGroup::non_modal) == dwell) {
        const double unit = run.settings.dialect == Dialect::fanuc ? 1e-3 : 1.0;
        run.out.post(CommandKind::dwell, 0, block['P'] * unit);
    }
    for (const BlockStep& step : steps) {
        const int code = block.code(step.group);
        if (code != no_code) {
            step.execute(run, block, code);
        }
        if (step.group == GGroup::lathe_diameter) {
            apply_diameter_mode(run.state, block);
        }
    }
}

/// Codes that only some dialects or machines know.
void refuse_codes_of_others(const Run& run, const Block& block) {
    constexpr int g43_4 = 434;
    if (block.code(GGroup::tool_length) == g43_4 && run.settings.dialect != Dialect::fanuc) {
        refuse(block.column_of(GGroup::tool_length), fmt::format("{} is not supported", g_name(g43_4)));
    }
    constexpr int last_user_code = 199;
    const int user = block.code(MGroup::user);
    const auto& remapped = run.settings.remapped_m;
    if (user > last_user_code && std::find(remapped.begin(), remapped.end(), user) == remapped.end()) {
        refuse(block.column_of(MGroup::user), fmt::format("M{} is not supported", user));
    }
}

/// What comes before everything else in a line.
void execute_settings(Run& run, const Block& block) {
    if (block.has_comment) {
        execute_comment(run, block.comment);
    }
    if (const int code = block.code(GGroup::spindle_mode); code != no_code) {
        set_spindle_mode(run, block, code);
    }
    if (const int code = block.code(GGroup::feed_mode); code != no_code) {
        set_feed_mode(run, code);
    }
    if (!feed_waits_for_unit(run, block)) {
        take_feed(run, block);
    }
    if (block.has('S')) {
        set_spindle_speed(run, block['S']);
    }
    if (block.has('T')) {
        select_tool(run, block);
    }
}

MoveWords words_of_moves(const Run& run, const Block& block) {
    constexpr int g53 = 530;
    constexpr int g91 = 910;
    MoveWords words;
    for (std::size_t n = 0; n < axis_count; ++n) {
        const bool polar = block.polar() && n < 2;
        words.named |= polar || block.has(axis_letters[n]) ? static_cast<AxisBits>(1U << n) : AxisBits{};
    }
    constexpr int threading = 760;
    if (is_drilling_cycle(block.motion)) { // goes across at the height where it is, before the word counts
        words.named &= static_cast<AxisBits>(~(1U << static_cast<unsigned>(axes_of(run.state.plane).third)));
    } else if (block.motion == threading) {
        words.named = 0;
    }
    const int distance = block.code(GGroup::distance);
    words.frame = block.code(GGroup::non_modal) == g53 ? MoveFrame::machine : MoveFrame::work;
    words.incremental =
        words.frame == MoveFrame::work &&
        (distance == no_code ? run.state.distance == DistanceMode::incremental : distance == g91);
    words.inverse_time = run.state.feed_mode == FeedMode::inverse_time;
    return words;
}

} // namespace

void execute_line(Run& run, ParsedLine& line) {
    Block& block = line.block;
    if (run.settings.dialect == Dialect::grbl) {
        apply_grbl_rules(block, run.state);
    }
    refuse_codes_of_others(run, block);
    apply_word_rules(block, run.state, run.settings.dialect);
    if (!line.assignments.empty()) {
        set_parameters(run, line.assignments);
    }
    constexpr std::uint32_t settings = words_of("FST");
    constexpr auto bit = [](GGroup group) { return 1U << static_cast<unsigned>(group); };
    constexpr std::uint32_t setting_groups = bit(GGroup::spindle_mode) | bit(GGroup::feed_mode);
    if (block.has_comment || block.has_any(settings) || (block.g_groups & setting_groups) != 0) {
        execute_settings(run, block);
    }
    if (block.m_groups != 0) {
        execute_m_codes(run, block);
    }
    if (block.motion != no_code || block.code(GGroup::non_modal) != no_code) {
        run.out.set_words(words_of_moves(run, block));
    }
    if ((block.g_groups & ~bit(GGroup::motion)) != 0) {
        execute_g_codes(run, block);
    } else {
        apply_diameter_mode(run.state, block);
    }
    if (block.motion != no_code) {
        execute_motion(run, block, block.motion);
    }
    if (const int code = block.code(MGroup::stopping); code != no_code) {
        execute_stop(run, block, code);
    }
}

void execute_text(Run& run, std::string_view words) {
    ParsedLine line;
    Cursor cursor(words);
    parse_words(cursor, run.variables, line);
    execute_line(run, line);
}

} // namespace millwright::gcode::internal
