#include "ui/toolpath_panels/modal_text.h"

#include "core/base/text.h"

#include <fmt/format.h>

#include <cmath>

namespace millwright::panels {

using gcode::FeedMode;
using gcode::LengthUnit;
using gcode::SpindleTurning;

std::string g_word(int tenths) {
    if (tenths == 800) {
        return "G80 none";
    }
    return tenths % 10 == 0 ? fmt::format("G{}", tenths / 10)
                            : fmt::format("G{}.{}", tenths / 10, tenths % 10);
}

std::string plane_text(gcode::Plane plane) {
    switch (plane) {
    case gcode::Plane::xy:
        return "G17 XY";
    case gcode::Plane::xz:
        return "G18 ZX";
    case gcode::Plane::yz:
        return "G19 YZ";
    case gcode::Plane::uv:
        return "G17.1 UV";
    case gcode::Plane::uw:
        return "G18.1 WU";
    case gcode::Plane::vw:
        return "G19.1 VW";
    }
    return {};
}

std::string coordinate_system_text(int system) {
    constexpr int last_whole = 6;
    return system <= last_whole ? fmt::format("G{}", 53 + system)
                                : fmt::format("G59.{}", system - last_whole);
}

std::string feed_text(const gcode::ModalView& state) {
    const std::string unit = state.unit == LengthUnit::inch ? "in" : "mm";
    const std::string value = shortest(std::round(static_cast<double>(state.feed) * 1000.0) / 1000.0);
    switch (state.feed_mode) {
    case FeedMode::per_minute:
        return fmt::format("G94, {} {}/min", value, unit);
    case FeedMode::inverse_time:
        return fmt::format("G93, {} /min", value);
    case FeedMode::per_revolution:
        return fmt::format("G95, {} {}/rev", value, unit);
    }
    return {};
}

std::string spindle_text(const gcode::ModalView& state) {
    const std::string speed = fmt::format("{:.0f} rpm", static_cast<double>(state.spindle_speed));
    switch (state.spindle) {
    case SpindleTurning::clockwise:
        return "M3, " + speed;
    case SpindleTurning::counterclockwise:
        return "M4, " + speed;
    case SpindleTurning::stopped:
        break;
    }
    return state.spindle_speed > 0.0F ? "stopped, S" + speed.substr(0, speed.find(' ')) : "stopped";
}

std::string coolant_text(const gcode::ModalView& state) {
    if (state.mist && state.flood) {
        return "M7 mist, M8 flood";
    }
    return state.mist ? "M7 mist" : state.flood ? "M8 flood" : "off";
}

std::string offset_text(const gcode::AxisValues& offset) {
    constexpr double least = 5e-4; // of three decimals
    std::string text;
    for (std::size_t n = 0; n < gcode::axis_count; ++n) {
        if (std::abs(offset[n]) >= least) {
            text +=
                fmt::format("{}{} {}", text.empty() ? "" : "  ", gcode::axis_letters[n], fixed(offset[n], 3));
        }
    }
    return text.empty() ? "none" : text;
}

} // namespace millwright::panels
