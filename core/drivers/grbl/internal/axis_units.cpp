#include "core/drivers/grbl/internal/axis_units.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/drivers/grbl/internal/grbl_session.h"

#include <fmt/format.h>

#include <algorithm>

namespace millwright::drivers::grbl {

bool is_rotary_axis(char letter) {
    return letter >= 'A' && letter <= 'C';
}

std::vector<program::ProgramAxis> program_axes(std::string_view letters) {
    using kinematics::AxisKind;
    std::vector<program::ProgramAxis> axes;
    for (const char letter : letters) {
        axes.push_back({letter, is_rotary_axis(letter) ? AxisKind::rotary : AxisKind::linear});
    }
    return axes;
}

bool counts_as_length(const Readout& readout, std::size_t n) {
    constexpr int rotary_mask = 376; // 1: the fourth axis, 2: the fifth
    constexpr std::size_t first = 3;
    if (!facts_of(readout.firmware).rotary_mask || n < first || n >= readout.axes.size() ||
        !is_rotary_axis(readout.axes[n])) {
        return false;
    }
    const auto mask = readout.settings.find(rotary_mask);
    const auto bits = mask == readout.settings.end() ? 0U : static_cast<unsigned>(mask->second);
    return (bits >> (n - first) & 1U) == 0U;
}

kinematics::AxisPositions eigen_of(const Axes& axes) {
    kinematics::AxisPositions result(std::ssize(axes));
    std::ranges::copy(axes, result.data());
    return result;
}

kinematics::AxisPositions positions_of(const Axes& axes, std::string_view letters) {
    kinematics::AxisPositions result = kinematics::AxisPositions::Zero(std::ssize(letters));
    for (std::size_t n = 0; n < std::min(axes.size(), letters.size()); ++n) {
        result[static_cast<Eigen::Index>(n)] = is_rotary_axis(letters[n]) ? from_degrees(axes[n]) : axes[n];
    }
    return result;
}

Jog in_axis_units(const Jog& jog, std::string_view letters) {
    if (jog.way.size() > std::ssize(letters)) {
        throw Error(
            fmt::format("the machine has the axes {}, but the jog has {} values", letters, jog.way.size()));
    }
    Jog result = jog;
    for (Eigen::Index n = 0; n < jog.way.size(); ++n) {
        if (is_rotary_axis(letters[static_cast<std::size_t>(n)])) {
            result.way[n] = to_degrees(jog.way[n]);
        }
    }
    const double length = jog.way.norm();
    result.speed = length > 0.0 ? jog.speed * result.way.norm() / length : jog.speed;
    return result;
}

} // namespace millwright::drivers::grbl
