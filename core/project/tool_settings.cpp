#include "core/project/tool_settings.h"

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

constexpr std::array<NumberSetting<ToolInput>, 12> of_tool{{
    {"diameter_mm", "Diameter", "mm", "Of the shank", 0.001, thickest, 3, field<&ToolInput::diameter_mm>},
    {"corner_radius_mm",
     "Corner radius",
     "mm",
     "Of a bull nose's corner, or of a cone's tip, where 0 is sharp",
     0.0,
     thickest,
     3,
     field<&ToolInput::corner_radius_mm>},
    {"half_angle_deg",
     "Half angle",
     "deg",
     "Of a cone, between its axis and its flank",
     0.01,
     89.0,
     2,
     field<&ToolInput::half_angle_deg>},
    {"length_mm",
     "Length",
     "mm",
     "From the tip to the holder",
     0.001,
     longest,
     2,
     field<&ToolInput::length_mm>},
    {"holder_diameter_mm",
     "Holder diameter",
     "mm",
     "Of the cylinder that begins where the cutter ends; 0 for no holder",
     0.0,
     thickest,
     2,
     field<&ToolInput::holder_diameter_mm>},
    {"holder_length_mm",
     "Holder length",
     "mm",
     "Of that cylinder",
     0.001,
     longest,
     2,
     field<&ToolInput::holder_length_mm>},
    {"lead_deg",
     "Lead",
     "deg",
     "By how much the tool leans forward, in the direction of the move, at the start of a track",
     -steepest,
     steepest,
     2,
     field<&ToolInput::lead_deg>},
    {"tilt_deg",
     "Tilt",
     "deg",
     "By how much the tool leans to the right of the move, at the start of a track",
     -steepest,
     steepest,
     2,
     field<&ToolInput::tilt_deg>},
    {"lead_change_deg",
     "Lead change",
     "deg",
     "What the lead grows by up to the end of the track, linear in its parameter",
     -steepest,
     steepest,
     2,
     field<&ToolInput::lead_change_deg>},
    {"tilt_change_deg",
     "Tilt change",
     "deg",
     "What the tilt grows by up to the end of the track, linear in its parameter",
     -steepest,
     steepest,
     2,
     field<&ToolInput::tilt_change_deg>},
    {"scallop_mm",
     "Scallop height",
     "mm",
     "What may be left between two tracks: the step-over is found for it",
     0.0001,
     10.0,
     4,
     field<&ToolInput::scallop_mm>},
    {"gouge_limit_mm",
     "Gouge limit",
     "mm",
     "Moves on which the cutter comes deeper than this below the surface are told",
     0.0001,
     100.0,
     4,
     field<&ToolInput::gouge_limit_mm>},
}};

constexpr std::array<Choice<CutterKind>, 5> of_cutter{{
    {CutterKind::point, "point", "Point", "No body: the tip is where the surface is touched"},
    {CutterKind::ball, "ball", "Ball end", "A half ball under its shank"},
    {CutterKind::flat, "flat", "Flat end", "A cylinder with a sharp edge"},
    {CutterKind::bull_nose, "bull-nose", "Bull nose", "A flat end whose edge is rounded"},
    {CutterKind::cone, "cone", "Cone", "A tapered cutter with a round or a sharp tip"},
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
                            : fmt::format("lead and tilt stay within {} deg up to the end of the track, "
                                          "and one of them reaches {:.6g}",
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

std::string tool_text(const ToolInput& input) {
    std::string text(row_of(cutter_kinds(), input.cutter).id);
    for (const NumberSetting<ToolInput>& setting : tool_numbers()) {
        const double value = setting.value(input);
        const bool of_holder = setting.id.starts_with("holder") && input.holder_diameter_mm <= 0.0;
        const bool said = setting.unit == "mm" || std::abs(value) > 0.0;
        const bool of_shape = !is_of_judgement(setting.id);
        if (said && of_shape && !of_holder && has_number(input.cutter, setting.id)) {
            std::string label(setting.label);
            label.front() = static_cast<char>(label.front() - 'A' + 'a');
            text += fmt::format(", {} {:.6g} {}", label, value, setting.unit);
        }
    }
    return text;
}

} // namespace millwright::project
