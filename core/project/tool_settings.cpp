#include "core/project/tool_settings.h"

#include "core/base/text.h"
#include "core/base/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace millwright::project {

namespace {

using toolpath::CutterKind;

constexpr double thickest = 500.0; // mm
constexpr double longest = 1000.0;
constexpr double steepest = 80.0; // deg
constexpr double most_tools = 9999.0;

constexpr std::array<NumberSetting<ToolInput>, 14> of_tool{{
    {"diameter_mm", "Diameter", "mm", "Shank diameter", 0.001, thickest, 3, field<&ToolInput::diameter_mm>},
    {"corner_radius_mm",
     "Corner radius",
     "mm",
     "Corner radius of a bull nose, or tip radius of a tapered cutter; 0 = sharp tip",
     0.0,
     thickest,
     3,
     field<&ToolInput::corner_radius_mm>},
    {"half_angle_deg",
     "Half angle",
     "deg",
     "Angle between axis and flank of a tapered cutter",
     0.01,
     89.0,
     2,
     field<&ToolInput::half_angle_deg>},
    {"length_mm",
     "Length",
     "mm",
     "Distance from tip to holder",
     0.001,
     longest,
     2,
     field<&ToolInput::length_mm>},
    {"holder_diameter_mm",
     "Holder diameter",
     "mm",
     "Diameter of the holder, a cylinder that begins where the cutter ends; 0 = no holder",
     0.0,
     thickest,
     2,
     field<&ToolInput::holder_diameter_mm>},
    {"holder_length_mm",
     "Holder length",
     "mm",
     "Length of the holder",
     0.001,
     longest,
     2,
     field<&ToolInput::holder_length_mm>},
    {"number",
     "Tool number",
     "",
     "T and H number in the program; 0 = no tool call, axis positions include the tool length",
     0.0,
     most_tools,
     0,
     field<&ToolInput::number>},
    {"gauge_length_mm",
     "Gauge length",
     "mm",
     "Distance from the spindle's gauge line to the tip, as in the control's tool table; 0 = cutter plus "
     "holder",
     0.0,
     2.0 * longest,
     3,
     field<&ToolInput::gauge_length_mm>},
    {"lead_deg",
     "Lead",
     "deg",
     "Forward inclination of the tool in the direction of travel, at the start of a track",
     -steepest,
     steepest,
     2,
     field<&ToolInput::lead_deg>},
    {"tilt_deg",
     "Tilt",
     "deg",
     "Inclination of the tool to the right of the direction of travel, at the start of a track",
     -steepest,
     steepest,
     2,
     field<&ToolInput::tilt_deg>},
    {"lead_change_deg",
     "Lead change",
     "deg",
     "Change of the lead up to the end of the track, linear in the track parameter",
     -steepest,
     steepest,
     2,
     field<&ToolInput::lead_change_deg>},
    {"tilt_change_deg",
     "Tilt change",
     "deg",
     "Change of the tilt up to the end of the track, linear in the track parameter",
     -steepest,
     steepest,
     2,
     field<&ToolInput::tilt_change_deg>},
    {"scallop_mm",
     "Scallop height",
     "mm",
     "Maximum height left between two tracks; the step-over is calculated from it",
     0.0001,
     10.0,
     4,
     field<&ToolInput::scallop_mm>},
    {"gouge_limit_mm",
     "Gouge limit",
     "mm",
     "Moves where the cutter goes deeper than this below the surface are reported",
     0.0001,
     100.0,
     4,
     field<&ToolInput::gouge_limit_mm>},
}};

constexpr std::array<Choice<CutterKind>, 5> of_cutter{{
    {CutterKind::point, "point", "Point", "No cutter body: the tip is the contact point"},
    {CutterKind::ball, "ball", "Ball end", "Hemispherical end"},
    {CutterKind::flat, "flat", "Flat end", "Cylindrical with a sharp edge"},
    {CutterKind::bull_nose, "bull-nose", "Bull nose", "Flat end with a rounded edge"},
    {CutterKind::cone, "cone", "Tapered", "Conical with a rounded or sharp tip"},
}};

toolpath::CutterShape cutter_of(const ToolInput& input) {
    return {.kind = input.cutter,
            .diameter = input.diameter_mm,
            .corner_radius = input.corner_radius_mm,
            .half_angle = from_degrees(input.half_angle_deg),
            .length = input.length_mm};
}

toolpath::HolderShape holder_of(const ToolInput& input) {
    return {.diameter = input.cutter == CutterKind::point ? 0.0 : input.holder_diameter_mm,
            .length = input.holder_length_mm};
}

/// A number that says nothing of the tool itself.
bool is_of_judgement(std::string_view id) {
    return id == "scallop_mm" || id == "gouge_limit_mm";
}

/// A number that says nothing of the tool's shape, but of its place in the control's tool table.
bool is_of_tool_table(std::string_view id) {
    return id == "number" || id == "gauge_length_mm";
}

/// The angle with the larger part at an end of the track.
double steepest_of(double start, double change) {
    return std::max(std::abs(start), std::abs(start + change));
}

} // namespace

std::span<const NumberSetting<ToolInput>> tool_numbers() {
    return of_tool;
}
std::span<const Choice<CutterKind>> cutter_kinds() {
    return of_cutter;
}

bool has_number(CutterKind kind, std::string_view id) {
    if (id == "corner_radius_mm") {
        return kind == CutterKind::bull_nose || kind == CutterKind::cone;
    }
    if (id == "half_angle_deg") {
        return kind == CutterKind::cone;
    }
    const bool of_body =
        id == "diameter_mm" || id == "length_mm" || is_of_judgement(id) || id.starts_with("holder");
    return !of_body || kind != CutterKind::point;
}

std::string fault_of(const ToolInput& input) {
    if (std::string fault = toolpath::fault_of(cutter_of(input)); !fault.empty()) {
        return fault;
    }
    if (std::string fault = toolpath::fault_of(holder_of(input)); !fault.empty()) {
        return fault;
    }
    const double most = std::max(steepest_of(input.lead_deg, input.lead_change_deg),
                                 steepest_of(input.tilt_deg, input.tilt_change_deg));
    return most <= steepest ? std::string()
                            : fmt::format("lead and tilt must stay within {} deg up to the end of the track; "
                                          "one of them reaches {:.6g}",
                                          steepest,
                                          most);
}

toolpath::Tool tool_of(const ToolInput& input) {
    return {.cutter = toolpath::body_of(cutter_of(input)),
            .holder = toolpath::body_of(holder_of(input), input.length_mm),
            .lean = {.lead = from_degrees(input.lead_deg),
                     .tilt = from_degrees(input.tilt_deg),
                     .lead_change = from_degrees(input.lead_change_deg),
                     .tilt_change = from_degrees(input.tilt_change_deg)}};
}

std::optional<double> gauge_length_mm(const ToolInput& input) {
    constexpr double micrometre = 1e-3;
    if (input.gauge_length_mm <= 0.0 && input.cutter == CutterKind::point) {
        return std::nullopt;
    }
    const double holder = input.holder_diameter_mm > 0.0 ? input.holder_length_mm : 0.0;
    const double length = input.gauge_length_mm > 0.0 ? input.gauge_length_mm : input.length_mm + holder;
    return std::max(1.0, std::round(length / micrometre)) * micrometre;
}

kinematics::MachineModel machine_with(const ToolInput& tool, const kinematics::MachineModel& machine) {
    const std::optional<double> length = gauge_length_mm(tool);
    return length ? machine.with_tool_length(*length) : machine;
}

std::optional<program::ProgramTool> program_tool(const ToolInput& input,
                                                 const kinematics::MachineModel& machine) {
    if (input.number == 0 || !gauge_length_mm(input)) {
        return std::nullopt;
    }
    return program::ProgramTool{input.number, machine.description().tool_length_offset};
}

std::optional<program::ProgramCutter> program_cutter(const ToolInput& input) {
    program::ProgramCutter cutter{
        .number = input.number, .diameter = input.diameter_mm, .corner_radius = 0.0};
    switch (input.cutter) {
    case CutterKind::point:
        return std::nullopt;
    case CutterKind::ball:
        cutter.corner_radius = input.diameter_mm / 2.0;
        cutter.kind = "ball end mill";
        break;
    case CutterKind::flat:
        cutter.kind = "flat end mill";
        break;
    case CutterKind::bull_nose:
        cutter.corner_radius = input.corner_radius_mm;
        cutter.kind = "bullnose end mill";
        break;
    case CutterKind::cone:
        cutter.corner_radius = input.corner_radius_mm;
        cutter.half_angle = from_degrees(input.half_angle_deg);
        cutter.kind = "tapered mill";
        break;
    }
    return cutter;
}

std::string tool_length_text(const ToolInput& input, const kinematics::MachineModel& machine) {
    const kinematics::MachineDescription& description = machine.description();
    const std::optional<double> length = gauge_length_mm(input);
    const double offset = description.tool_length_offset;
    std::string text;
    if (!length) {
        text = description.tool_length ? fmt::format("gauge length {} mm, that of the machine file's tool",
                                                     shortest(*description.tool_length))
                                       : "that of the machine file's tool, not specified there";
    } else if (!description.tool_length) {
        text = fmt::format("gauge length {} mm; the machine zeros do not depend on it", shortest(*length));
    } else {
        text = fmt::format("gauge length {} mm, {} the machine file's tool of {} mm",
                           shortest(*length),
                           std::abs(offset) > 0.0 ? fmt::format("{} mm {} than",
                                                                shortest(std::abs(offset)),
                                                                offset > 0.0 ? "longer" : "shorter")
                                                  : "as long as",
                           shortest(*length - offset));
    }
    return machine.swings_tool() ? text + "; the head tilts the tool: without tip control, axis positions "
                                          "are valid for this length only"
                                 : text;
}

std::string tool_text(const ToolInput& input) {
    std::string text(row_of(cutter_kinds(), input.cutter).id);
    for (const NumberSetting<ToolInput>& setting : tool_numbers()) {
        const double value = setting.value(input);
        const bool of_holder = setting.id.starts_with("holder") && input.holder_diameter_mm <= 0.0;
        const bool said = setting.unit == "mm" || std::abs(value) > 0.0;
        const bool of_shape = !is_of_judgement(setting.id) && !is_of_tool_table(setting.id);
        if (said && of_shape && !of_holder && has_number(input.cutter, setting.id)) {
            std::string label(setting.label);
            label.front() = static_cast<char>(label.front() - 'A' + 'a');
            text += fmt::format(", {} {:.6g} {}", label, value, setting.unit);
        }
    }
    return text;
}

} // namespace millwright::project
