#include "core/machine/drivers/pmac/pmac_program.h"

#include "core/base/error.h"
#include "core/base/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace millwright::machine {

namespace {

constexpr int most_steps = 15'000; // lines of a program

void refuse_undriven(const motion::Trajectory& motion, Eigen::Index driven, double step) {
    const kinematics::AxisPositions start = motion.at(0.0).position;
    constexpr double still = 1e-6; // rad
    for (double time = 0.0; time < motion.duration() + step; time += step) {
        const kinematics::AxisPositions at = motion.at(time).position;
        for (Eigen::Index n = driven; n < at.size(); ++n) {
            if (std::abs(at[n] - start[n]) > still) {
                throw Error(fmt::format("joint {} would have to move, and the card does not drive it", n + 1),
                            {},
                            "teach points with the same joint there");
            }
        }
    }
}

} // namespace

std::vector<std::string>
pmac_program(const motion::Trajectory& motion, const PmacSettings& settings, double step) {
    expects(step > 0.0, "a step of time");
    const auto driven = static_cast<Eigen::Index>(settings.axes.size());
    refuse_undriven(motion, driven, step);
    const double steps = std::max(1.0, std::ceil(motion.duration() / step));
    if (steps > most_steps) {
        throw Error(fmt::format("the motion takes {:.0f} s, too long for the card's memory at steps of {} s",
                                motion.duration(),
                                step));
    }
    constexpr double ms = 1000.0;
    std::string axes;
    for (const PmacAxis& axis : settings.axes) {
        axes += fmt::format("{}{}", axes.empty() ? "" : ",", axis.letter);
    }
    const double even = std::max(1e-3, motion.duration() / steps);
    std::vector<std::string> lines{"LINEAR",
                                   "ABS",
                                   fmt::format("FRAX({})", axes),
                                   "TS0",
                                   fmt::format("TA{:.4f}", even * ms),
                                   fmt::format("TM{:.4f}", even * ms)};
    for (int n = 1; n <= static_cast<int>(steps); ++n) {
        const kinematics::AxisPositions at = motion.at(n * even).position;
        std::string line;
        for (Eigen::Index axis = 0; axis < std::min(driven, at.size()); ++axis) {
            line += fmt::format("{}{}{:.5f}",
                                line.empty() ? "" : " ",
                                settings.axes[static_cast<std::size_t>(axis)].letter,
                                to_degrees(at[axis]));
        }
        lines.push_back(std::move(line));
    }
    return lines;
}

} // namespace millwright::machine
