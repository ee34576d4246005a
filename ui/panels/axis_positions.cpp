#include "ui/panels/axis_positions.h"

#include "core/base/text.h"
#include "core/base/units.h"
#include "core/kinematics/forward.h"
#include "ui/widgets/readout.h"

#include <fmt/format.h>

#include <cmath>
#include <span>
#include <string>
#include <vector>

namespace millwright::panels {

namespace {

using kinematics::AxisKind;

std::vector<widgets::AxisReading> readings(const kinematics::MachineModel& machine,
                                           const kinematics::AxisPositions& position,
                                           std::vector<std::string>& letters) {
    for (const kinematics::MachineAxis& axis : machine.axes()) {
        letters.emplace_back(1, axis.letter);
    }
    std::vector<widgets::AxisReading> result;
    for (int n = 0; n < machine.axis_count(); ++n) {
        const kinematics::MachineAxis& axis = machine.axis(n);
        const bool rotary = axis.kind == AxisKind::rotary;
        widgets::AxisReading reading;
        reading.letter = letters[static_cast<std::size_t>(n)];
        reading.value = rotary ? to_degrees(position[n]) : position[n];
        reading.unit = rotary ? "\u00b0" : "mm";
        reading.state = travel_limit_state(axis, position[n]);
        result.push_back(reading);
    }
    return result;
}

std::string why_not_known(const FrameState& now) {
    if (!now.in_file() || !now.opened->finished) {
        return "No program yet.";
    }
    return "Rotary axis positions are available for planned programs only. " + now.opened->no_motion;
}

} // namespace

widgets::AxisState travel_limit_state(const kinematics::MachineAxis& axis, double position) {
    constexpr double rounding = 1e-9; // mm or rad
    const double margin = 0.05 * (axis.max - axis.min);
    if (position < axis.min - rounding || position > axis.max + rounding) {
        return widgets::AxisState::beyond_limit;
    }
    const bool near = std::isfinite(margin) && (position < axis.min + margin || position > axis.max - margin);
    return near ? widgets::AxisState::near_limit : widgets::AxisState::normal;
}

TravelWords travel_words(std::span<const widgets::AxisReading> axes) {
    const auto letters = [axes](widgets::AxisState state) {
        std::string found;
        for (const widgets::AxisReading& axis : axes) {
            if (axis.state == state) {
                found += (found.empty() ? "" : ", ") + std::string(axis.letter);
            }
        }
        return found;
    };
    if (const std::string beyond = letters(widgets::AxisState::beyond_limit); !beyond.empty()) {
        return {"Beyond travel limit: " + beyond, widgets::Tone::danger};
    }
    if (const std::string near = letters(widgets::AxisState::near_limit); !near.empty()) {
        return {"Near travel limit: " + near, widgets::Tone::warning};
    }
    return {"Within travel limits", widgets::Tone::muted};
}

void axis_positions(Ui& ui, const FrameState& now) {
    const auto machine = now.machine();
    if (!machine) {
        return;
    }
    const auto moment = now.moment();
    if (!moment || moment->axes.size() != machine->axis_count()) {
        ui.note(why_not_known(now));
        return;
    }
    std::vector<std::string> letters;
    const auto axes = readings(*machine, moment->axes, letters);
    widgets::readout(ui, "axes", axes);
    const TravelWords words = travel_words(axes);
    ui.words(words.text,
             words.tone); // always one line, so that nothing below it moves while the motion is played
    const geometry::ToolPose pose = kinematics::forward(*machine, moment->axes);
    const auto labels = ui.label_share(0.36F);
    ui.value(
        "tip",
        "Tip on the part",
        fmt::format("{}  {}  {}", fixed(pose.tip.x(), 1), fixed(pose.tip.y(), 1), fixed(pose.tip.z(), 1)),
        "mm");
    ui.value(
        "axis",
        "Tool axis",
        fmt::format("{}  {}  {}", fixed(pose.axis.x(), 3), fixed(pose.axis.y(), 3), fixed(pose.axis.z(), 3)));
}

} // namespace millwright::panels
