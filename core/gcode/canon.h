// What a program tells the machine, one operation at a time: the canonical commands of RS-274/NGC, as
// LinuxCNC names and orders them. Positions are those of the active coordinate system, in the length unit
// that the last use_length_units named (mm or inch), degrees, and units per minute; offsets and rotation come
// as commands of their own. The reader calls a sink; nothing is kept.
#pragma once

#include "core/gcode/axes.h"
#include "core/gcode/tool_table.h"
#include "core/program/path_mode.h"

#include <cstdint>
#include <span>
#include <string_view>

namespace millwright::gcode {

enum class Plane : std::uint8_t { xy, xz, yz, uv, uw, vw };

/// A line of a program. Files count in the order in which they were opened; 0 is the program itself.
struct SourcePlace {
    std::int32_t line = 0; ///< from 1
    std::int32_t file = 0;

    friend bool operator==(const SourcePlace&, const SourcePlace&) = default;
};

/// The line that is being executed. Valid during the call.
struct SourceLine {
    SourcePlace place;
    std::string_view text; ///< without its end
};

enum class MoveKind : std::uint8_t { traverse, feed, arc, probe, rigid_tap };

/// In whose terms the program gives the end of a move.
enum class MoveFrame : std::uint8_t {
    work,        ///< the active coordinate system
    machine,     ///< G53
    reference,   ///< the stored position of G28
    reference_2, ///< that of G30
};

/// Axes, one bit each in the order of axis_letters.
using AxisBits = std::uint16_t;

/// What a line says about the ends of its moves.
struct MoveWords {
    AxisBits named = 0;        ///< axes with a word
    bool incremental = false;  ///< the words count from where the axes are
    bool inverse_time = false; ///< the feed is a time, whatever the length
    MoveFrame frame = MoveFrame::work;
    AxisBits reference_set = 0; ///< reference, reference_2: axes whose position has been stored

    [[nodiscard]] bool names(std::size_t axis) const { return ((named >> axis) & 1U) != 0; }
};

/// A motion from where the axes are to `target`. An arc turns in `plane`, whose axes are X Y (xy), Z X (xz)
/// or Y Z (yz), and moves the other axes linearly with the angle.
struct Move {
    MoveKind kind = MoveKind::traverse;
    Plane plane = Plane::xy;
    std::uint8_t probe = 2; ///< probe: 2 to 5, as in G38.2 to G38.5
    std::int32_t turns = 0; ///< arc: full and partial turns, > 0 counter-clockwise, < 0 clockwise
    SourcePlace source;     ///< of the line that asks for it
    MoveWords words;
    AxisValues target;
    double centre_1 = 0.0; ///< arc: along the plane's first axis
    double centre_2 = 0.0; ///< arc: along the plane's second axis
    double sweep = 0.0;    ///< arc: all of the turn, rad, > 0 counter-clockwise; at least hair_sweep
    /// Straight, onto a path with cutter compensation: its end depends on where it begins in `plane`.
    bool enters_compensation = false;
};

/// Arcs of less are taken as full turns, as LinuxCNC's motion does (posemath's CIRCLE_FUZZ), rad.
inline constexpr double hair_sweep = 1e-6;

struct ControlPoint {
    double x = 0.0, y = 0.0, weight = 1.0;
};

/// A rational B-spline in the XY plane at constant Z, of the given order (degree + 1), clamped and uniform.
/// The first point is where the axes are.
struct Curve {
    std::span<const ControlPoint> points;
    int order = 3;
    SourcePlace source;
};

/// Which members of Command count stands behind each.
enum class CommandKind : std::uint8_t {
    use_length_units,        ///< index: 1 inch, 2 mm
    set_g5x_offset,          ///< index: coordinate system 1 to 9; mode: AxisBits whose offset is known; axes
    set_g92_offset,          ///< mode: AxisBits whose offset is known; axes
    set_xy_rotation,         ///< index: 1 if it is known, else 0; value: degrees
    set_feed_reference,      ///< always XYZ
    set_feed_mode,           ///< index: 0 per minute (or inverse time), 1 per revolution
    set_feed_rate,           ///< value
    set_motion_control_mode, ///< index: PathMode; value: tolerance; mode: ModeOrigin
    set_naivecam_tolerance,  ///< value
    select_plane,            ///< index: Plane
    start_speed_feed_synch,  ///< value: feed per revolution
    stop_speed_feed_synch,
    dwell,             ///< value: s
    set_spindle_mode,  ///< value: 0 constant rpm, else constant surface speed up to so many rpm
    set_spindle_speed, ///< value
    start_spindle_clockwise,
    start_spindle_counterclockwise,
    stop_spindle_turning,
    orient_spindle,         ///< value: degrees; index: direction, 0 shortest way, 1 clockwise, 2 counter
    wait_spindle_orient,    ///< value: s
    use_tool_length_offset, ///< axes
    control_tip,            ///< index: 1 from here on X Y Z are the tool's tip on the part, 0 no more
    select_tool,            ///< index: tool number
    start_change,
    change_tool,          ///< index: row in the tool table
    change_tool_number,   ///< index: row in the tool table
    set_tool_table_entry, ///< index: row; tool
    comment,              ///< text
    message,
    print,
    log,
    logopen,
    logappend,
    logclose,
    mist_on,
    mist_off,
    flood_on,
    flood_off,
    enable_feed_override,
    disable_feed_override,
    enable_speed_override,
    disable_speed_override,
    enable_adaptive_feed,
    disable_adaptive_feed,
    enable_feed_hold,
    disable_feed_hold,
    turn_probe_on,
    turn_probe_off,
    set_motion_output_bit,   ///< index
    clear_motion_output_bit, ///< index
    set_aux_output_bit,      ///< index
    clear_aux_output_bit,    ///< index
    set_motion_output_value, ///< index; value
    set_aux_output_value,    ///< index; value
    wait_input,              ///< index; mode: 0 to 4, 5 analog; value: s
    user_command,            ///< index: 100 to 199; value: P; value_2: Q
    pallet_shuttle,
    program_stop,
    optional_program_stop,
    program_end,
    finish, ///< the text ended with %, without M2
    on_reset,
    /// An offset, a reference point or a parameter is taken from where the axes are. index: of G, in tenths
    /// (920: G92, 100: G10 L10, L11 and L20, 281, 301), 0: a parameter in column `value`, of the machine
    /// position where value_2 is 1; mode: which axes, AxisBits. Not one of LinuxCNC's.
    measure_position,
    /// The program reads parameter #index, in column `mode`, whose value only the control knows: it is taken
    /// for 0. Not one of LinuxCNC's.
    read_unknown
};

/// Who asks for a path mode.
enum class ModeOrigin : std::uint8_t {
    program,
    cycle,    ///< a canned cycle, for its own moves
    cycle_end ///< back to what was in force before it
};

struct Command {
    CommandKind kind = CommandKind::comment;
    int index = 0;
    int mode = 0;
    double value = 0.0;
    double value_2 = 0.0;
    SourcePlace source;
    AxisValues axes;
    Tool tool;
    std::string_view text; ///< valid during the call
};

/// Takes what a program does. `now` is the line being executed: later than the operation's own where cutter
/// compensation had to wait for the next move.
class CanonSink {
public:
    CanonSink() = default;
    CanonSink(const CanonSink&) = default;
    CanonSink& operator=(const CanonSink&) = default;
    virtual ~CanonSink() = default;

    virtual void move(const Move& move, const SourceLine& now) = 0;
    virtual void curve(const Curve& curve, const SourceLine& now) = 0;
    virtual void command(const Command& command, const SourceLine& now) = 0;
};

} // namespace millwright::gcode
