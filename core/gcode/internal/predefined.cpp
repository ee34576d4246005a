// LinuxCNC's predefined named parameters: what is in force, as numbers.
#include "core/gcode/internal/codes.h"
#include "core/gcode/internal/offsets.h"
#include "core/gcode/internal/variables.h"

#include <algorithm>
#include <array>

namespace millwright::gcode::internal {

namespace {

struct Asked {
    const ModalState& state;
    const ProgramView& program;
};

using Answer = double (*)(const Asked&);

struct Entry {
    std::string_view name;
    Answer answer;
};

constexpr double yes(bool holds) {
    return holds ? 1.0 : 0.0;
}

double side_code(CutterSide side) {
    return side == CutterSide::right ? 420 : side == CutterSide::left ? 410 : 400;
}

bool any(const AxisValues& values) {
    for (std::size_t n = 0; n < axis_count; ++n) {
        if (values[n] < 0.0 || values[n] > 0.0) {
            return true;
        }
    }
    return false;
}

template <Axis axis> double position(const Asked& a) {
    return a.state.position[axis];
}

/// In machine coordinates.
template <Axis axis> double machine_position(const Asked& a) {
    const ModalState& s = a.state;
    return (rotated(s.position + s.g92_offset, s.rotation_deg) + s.g5x_offset + s.tool_offset)[axis];
}

constexpr double version_major = 2.9; // of the LinuxCNC that is described
constexpr double version_minor = 0.0;

const std::array<Entry, 56> entries{{
    {"_line", [](const Asked& a) -> double { return a.program.line; }},
    {"_motion_mode", [](const Asked& a) -> double { return a.state.motion; }},
    {"_plane", [](const Asked& a) -> double { return plane_code(a.state.plane); }},
    {"_ccomp", [](const Asked& a) { return side_code(a.state.cutter.side); }},
    {"_metric", [](const Asked& a) { return yes(a.state.unit == LengthUnit::mm); }},
    {"_imperial", [](const Asked& a) { return yes(a.state.unit == LengthUnit::inch); }},
    {"_absolute", [](const Asked& a) { return yes(a.state.distance == DistanceMode::absolute); }},
    {"_incremental", [](const Asked& a) { return yes(a.state.distance == DistanceMode::incremental); }},
    {"_inverse_time", [](const Asked& a) { return yes(a.state.feed_mode == FeedMode::inverse_time); }},
    {"_units_per_minute", [](const Asked& a) { return yes(a.state.feed_mode == FeedMode::per_minute); }},
    {"_units_per_rev", [](const Asked& a) { return yes(a.state.feed_mode == FeedMode::per_revolution); }},
    {"_coord_system", [](const Asked& a) -> double { return system_code(a.state.coordinate_system); }},
    {"_tool_offset", [](const Asked& a) { return yes(any(a.state.tool_offset)); }},
    {"_retract_r_plane", [](const Asked& a) { return yes(a.state.cycle_return == CycleReturn::r_level); }},
    {"_retract_old_z",
     [](const Asked& a) { return yes(a.state.cycle_return == CycleReturn::initial_level); }},
    {"_spindle_rpm_mode",
     [](const Asked& a) { return yes(a.state.spindle_mode == SpindleMode::constant_speed); }},
    {"_spindle_css_mode",
     [](const Asked& a) { return yes(a.state.spindle_mode == SpindleMode::constant_surface_speed); }},
    {"_ijk_absolute_mode",
     [](const Asked& a) { return yes(a.state.arc_distance == DistanceMode::absolute); }},
    {"_lathe_diameter_mode", [](const Asked& a) { return yes(a.state.diameter_mode); }},
    {"_lathe_radius_mode", [](const Asked& a) { return yes(!a.state.diameter_mode); }},
    {"_spindle_on", [](const Asked& a) { return yes(a.state.spindle != SpindleTurning::stopped); }},
    {"_spindle_cw", [](const Asked& a) { return yes(a.state.spindle == SpindleTurning::clockwise); }},
    {"_mist", [](const Asked& a) { return yes(a.state.mist); }},
    {"_flood", [](const Asked& a) { return yes(a.state.flood); }},
    {"_speed_override", [](const Asked& a) { return yes(a.state.overrides.speed); }},
    {"_feed_override", [](const Asked& a) { return yes(a.state.overrides.feed); }},
    {"_adaptive_feed", [](const Asked& a) { return yes(a.state.overrides.adaptive_feed); }},
    {"_feed_hold", [](const Asked& a) { return yes(a.state.overrides.feed_hold); }},
    {"_feed", [](const Asked& a) { return a.state.feed_rate; }},
    {"_rpm", [](const Asked& a) { return a.state.spindle_speed; }},
    {"_current_tool", [](const Asked& a) -> double { return a.state.spindle_tool.number; }},
    {"_current_pocket", [](const Asked& a) -> double { return a.state.row_in_spindle; }},
    {"_selected_tool", [](const Asked& a) -> double { return a.state.selected_tool; }},
    {"_selected_pocket", [](const Asked& a) -> double { return a.state.selected_row; }},
    {"_x", position<Axis::x>},
    {"_y", position<Axis::y>},
    {"_z", position<Axis::z>},
    {"_a", position<Axis::a>},
    {"_b", position<Axis::b>},
    {"_c", position<Axis::c>},
    {"_u", position<Axis::u>},
    {"_v", position<Axis::v>},
    {"_w", position<Axis::w>},
    {"_abs_x", machine_position<Axis::x>},
    {"_abs_y", machine_position<Axis::y>},
    {"_abs_z", machine_position<Axis::z>},
    {"_abs_a", machine_position<Axis::a>},
    {"_abs_b", machine_position<Axis::b>},
    {"_abs_c", machine_position<Axis::c>},
    {"_value", [](const Asked& a) { return a.program.return_value; }},
    {"_value_returned", [](const Asked& a) { return yes(a.program.value_returned); }},
    {"_call_level", [](const Asked& a) -> double { return a.program.call_level; }},
    {"_remap_level", [](const Asked&) { return 0.0; }},
    {"_task", [](const Asked&) { return 0.0; }},
    {"_vmajor", [](const Asked&) { return version_major; }},
    {"_vminor", [](const Asked&) { return version_minor; }},
}};

} // namespace

std::optional<double>
predefined_value(std::string_view name, const ModalState& state, const ProgramView& program) {
    const auto* const found = std::find_if(
        entries.begin(), entries.end(), [name](const Entry& entry) { return entry.name == name; });
    return found == entries.end() ? std::nullopt : std::optional<double>(found->answer({state, program}));
}

} // namespace millwright::gcode::internal
