// What the numbers and choices of path, program and machine say of themselves; those of the grids:
// grid_settings.cpp.
#include "core/project/setting_tables.h"

#include <array>

namespace millwright::project {

namespace {

using kinematics::AngleMode;
using toolpath::SequencingGoal;

constexpr std::array<NumberSetting<ToolSetInput>, 4> of_tool_set{{
    {"e", "Eccentricity e", "mm", "Eccentricity of the tilt axis B", -1e4, 1e4, 3, field<&ToolSetInput::e>},
    {"OF",
     "Tip to base OF",
     "mm",
     "From tool tip to machine base; the machine has the difference B4 - OF",
     -1e4,
     1e4,
     3,
     field<&ToolSetInput::OF>},
    {"AB",
     "Table to tilt AB",
     "mm",
     "From the rotary table (axis A) to the tilt axis B",
     -1e4,
     1e4,
     3,
     field<&ToolSetInput::AB>},
    {"B4",
     "Tilt to base B4",
     "mm",
     "From the tilt axis B to the machine base",
     -1e4,
     1e4,
     3,
     field<&ToolSetInput::B4>},
}};

constexpr std::array<NumberSetting<ToolpathInput>, 1> of_toolpath{{
    {"tolerance_mm",
     "Tolerance",
     "mm",
     "Maximum deviation of the tool tip from the surface curve between two points",
     1e-4,
     100.0,
     4,
     field<&ToolpathInput::tolerance_mm>},
}};

constexpr std::array<NumberSetting<SequencingInput>, 1> of_sequencing{{
    {"largest_step_deg",
     "Max. rotary step",
     "deg",
     "Points are added where a rotary axis would turn further than this between two points; 0 = none",
     0.0,
     180.0,
     2,
     field<&SequencingInput::largest_step_deg>},
}};

constexpr std::array<NumberSetting<ProgramInput>, 5> of_program{{
    {"feed_mm_per_min",
     "Feed rate",
     "mm/min",
     "Speed of the tool tip on the part while cutting; reduced where an axis cannot follow",
     0.1,
     1e5,
     1,
     field<&ProgramInput::feed_mm_per_min>},
    {"plunge_mm_per_min",
     "Plunge feed",
     "mm/min",
     "Speed of the tool tip towards the part",
     0.1,
     1e5,
     1,
     field<&ProgramInput::plunge_mm_per_min>},
    {"spindle_rpm",
     "Spindle speed",
     "1/min",
     "Spindle speed; 0 = no spindle commands",
     0.0,
     2e5,
     0,
     field<&ProgramInput::spindle_rpm>},
    {"link_clearance_mm",
     "Link clearance",
     "mm",
     "Retract distance from the part between two tracks",
     0.01,
     1e3,
     2,
     field<&ProgramInput::link_clearance_mm>},
    {"approach_clearance_mm",
     "Approach height",
     "mm",
     "Height above the first and last pose for approach and retract",
     0.01,
     1e3,
     2,
     field<&ProgramInput::approach_clearance_mm>},
}};

constexpr std::array<Choice<StrategyInput>, 5> of_strategy{{
    {StrategyInput::zigzag, "zigzag", "Zigzag", "Grid nodes, track by track, in alternating directions"},
    {StrategyInput::iso_parametric,
     "iso-parametric",
     "Iso-parametric",
     "Equal parameter steps in alternating directions, whichever grid is selected"},
    {StrategyInput::spiral, "spiral", "Spiral", "Grid nodes in an inward spiral, without lifting"},
    {StrategyInput::constant_scallop,
     "constant-scallop",
     "Constant scallop",
     "Tracks as far apart as the cutter allows everywhere; needs a cutter"},
    {StrategyInput::fewest_points,
     "fewest-points",
     "Fewest points",
     "Straight tracks with the fewest points that meet the tolerance"},
}};

constexpr std::array<Choice<SequencingGoal>, 4> of_sequencing_goal{{
    {SequencingGoal::nearest,
     "nearest",
     "Nearest",
     "Each point takes the rotary angles nearest to those of the point before"},
    {SequencingGoal::travel,
     "travel",
     "Minimum rotation",
     "Least travel of the rotary axes over all branches and turns"},
    {SequencingGoal::error,
     "error",
     "Minimum error",
     "Moves closest to the surface over all branches and turns"},
    {SequencingGoal::time,
     "time",
     "Minimum time",
     "Shortest time at the axes' maximum velocities, over all branches and turns"},
}};

constexpr std::array<Choice<LinkInput>, 2> of_link{{
    {LinkInput::lifted, "lifted", "Lifted", "Retracts along the tool axis, crosses, and returns"},
    {LinkInput::on_surface, "on-surface", "On the surface", "Cuts straight across to the next track"},
}};

constexpr std::array<Choice<AngleMode>, 3> of_angles{{
    {AngleMode::consistent, "consistent", "Consistent", "The tool axis lies along the surface normal"},
    {AngleMode::faulty_text,
     "faulty-text",
     "Faulty (text)",
     "The table in chapter 3 of the thesis, which tilts by the complement. For regression tests only"},
    {AngleMode::faulty_listing,
     "faulty-listing",
     "Faulty (listing)",
     "The thesis's listing, which also has a wrong sign of A. For regression tests only"},
}};

} // namespace

std::span<const NumberSetting<ToolpathInput>> toolpath_numbers() {
    return of_toolpath;
}
std::span<const NumberSetting<SequencingInput>> sequencing_numbers() {
    return of_sequencing;
}
std::span<const NumberSetting<ProgramInput>> program_numbers() {
    return of_program;
}
std::span<const Choice<StrategyInput>> strategies() {
    return of_strategy;
}
std::span<const Choice<SequencingGoal>> sequencing_goals() {
    return of_sequencing_goal;
}
std::span<const Choice<LinkInput>> links() {
    return of_link;
}
std::span<const NumberSetting<ToolSetInput>> tool_set_numbers() {
    return of_tool_set;
}
std::span<const Choice<AngleMode>> angle_modes() {
    return of_angles;
}

} // namespace millwright::project
