// What the numbers and choices of path, program and machine say of themselves; those of the grids:
// grid_settings.cpp.
#include "core/project/settings.h"

#include <array>

namespace millwright::project {

namespace {

using kinematics::AngleMode;
using toolpath::SequencingGoal;

constexpr std::array<NumberSetting<ToolSetInput>, 4> of_tool_set{{
    {"e", "Eccentricity e", "mm", "Of the tilt axis B", -1e4, 1e4, 3, field<&ToolSetInput::e>},
    {"OF",
     "Tip to base OF",
     "mm",
     "From the tool tip to the machine's base; the machine has the difference B4 - OF",
     -1e4,
     1e4,
     3,
     field<&ToolSetInput::OF>},
    {"AB",
     "Table to tilt AB",
     "mm",
     "From the rotary table, axis A, to the tilt axis B",
     -1e4,
     1e4,
     3,
     field<&ToolSetInput::AB>},
    {"B4",
     "Tilt to base B4",
     "mm",
     "From the tilt axis B to the machine's base",
     -1e4,
     1e4,
     3,
     field<&ToolSetInput::B4>},
}};

constexpr std::array<NumberSetting<ToolpathInput>, 1> of_toolpath{{
    {"tolerance_mm",
     "Tolerance",
     "mm",
     "How far the true tip may be off the surface curve between two points",
     1e-4,
     100.0,
     4,
     field<&ToolpathInput::tolerance_mm>},
}};

constexpr std::array<NumberSetting<SequencingInput>, 1> of_sequencing{{
    {"largest_step_deg",
     "Largest turn",
     "deg",
     "Points are added where a rotary axis would turn by more from one to the next; 0 adds none",
     0.0,
     180.0,
     2,
     field<&SequencingInput::largest_step_deg>},
}};

constexpr std::array<NumberSetting<ProgramInput>, 5> of_program{{
    {"feed_mm_per_min",
     "Feed",
     "mm/min",
     "Speed of the tool tip on the part while cutting; less where an axis cannot follow",
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
     "Spindle",
     "1/min",
     "Turning speed of the spindle; 0 leaves it alone",
     0.0,
     2e5,
     0,
     field<&ProgramInput::spindle_rpm>},
    {"link_clearance_mm",
     "Link clearance",
     "mm",
     "How far the tool is lifted off the part between two tracks",
     0.01,
     1e3,
     2,
     field<&ProgramInput::link_clearance_mm>},
    {"approach_clearance_mm",
     "Approach height",
     "mm",
     "Height above the first and the last pose at which the tool comes and goes",
     0.01,
     1e3,
     2,
     field<&ProgramInput::approach_clearance_mm>},
}};

constexpr std::array<Choice<StrategyInput>, 5> of_strategy{{
    {StrategyInput::zigzag, "zigzag", "Zigzag", "The nodes of the grid, track after track, to and fro"},
    {StrategyInput::iso_parametric,
     "iso-parametric",
     "Iso-parametric",
     "To and fro over equal steps of the parameters, whatever grid was chosen"},
    {StrategyInput::spiral,
     "spiral",
     "Spiral",
     "The nodes of the grid, round after round inwards, without a lift"},
    {StrategyInput::constant_scallop,
     "constant-scallop",
     "Constant scallop",
     "Tracks as far apart as the cutter may go everywhere; needs a cutter"},
    {StrategyInput::fewest_points,
     "fewest-points",
     "Fewest points",
     "Straight tracks, each with the fewest points that keep the tolerance"},
}};

constexpr std::array<Choice<SequencingGoal>, 4> of_sequencing_goal{{
    {SequencingGoal::nearest, "nearest", "Nearest", "Each point takes the rotary angles nearest to the last"},
    {SequencingGoal::travel,
     "travel",
     "Minimum rotation",
     "Of all ways through the branches and turns the one with the least travel of the rotary axes"},
    {SequencingGoal::error,
     "error",
     "Minimum error",
     "Of all ways the one whose moves stay nearest to the surface"},
    {SequencingGoal::time, "time", "Minimum time", "Of all ways the fastest at the axes' largest velocities"},
}};

constexpr std::array<Choice<LinkInput>, 2> of_link{{
    {LinkInput::lifted, "lifted", "Lifted", "Off the part along the tool axis, across, and back down"},
    {LinkInput::on_surface, "on-surface", "On the surface", "Straight to the next track, cutting"},
}};

constexpr std::array<Choice<AngleMode>, 3> of_angles{{
    {AngleMode::consistent, "consistent", "Consistent", "The tool axis lies along the surface normal"},
    {AngleMode::faulty_text,
     "faulty-text",
     "Faulty (text)",
     "The table of the thesis's chapter 3, which tilts by the complement. For regression only"},
    {AngleMode::faulty_listing,
     "faulty-listing",
     "Faulty (listing)",
     "The thesis's listing, with a wrong sign of A as well. For regression only"},
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
