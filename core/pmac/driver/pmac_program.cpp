#include "core/pmac/driver/pmac_program.h"

#include "core/base/error.h"
#include "core/base/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>

namespace millwright::pmac {

namespace {

constexpr double ms = 1000.0;

void refuse_undriven(const motion::Trajectory& motion, Eigen::Index driven, double step) {
    const kinematics::AxisPositions start = motion.at(0.0).position;
    constexpr double still = 1e-6; // rad
    for (double time = 0.0; time < motion.duration() + step; time += step) {
        const kinematics::AxisPositions at = motion.at(time).position;
        for (Eigen::Index n = driven; n < at.size(); ++n) {
            if (std::abs(at[n] - start[n]) > still) {
                throw Error(fmt::format("joint {} would have to move, but the card does not drive it", n + 1),
                            {},
                            "teach points with the same position of this joint");
            }
        }
    }
}

/// Where the motors are at even steps of time: degrees of each driven axis.
using Places = std::vector<kinematics::AxisPositions>;

Places places_of(const motion::Trajectory& motion, Eigen::Index driven, int steps) {
    Places places;
    places.reserve(static_cast<std::size_t>(steps) + 1);
    for (int n = 0; n <= steps; ++n) {
        const kinematics::AxisPositions at = motion.at(motion.duration() * n / steps).position;
        places.push_back(at.head(std::min(driven, at.size())) * to_degrees(1.0));
    }
    return places;
}

/// How many steps one straight move from `first` may last, so that no motor is off its places between by more
/// than a quarter of a count. Each place on the way leaves a cone of slopes; the move's own has to lie in it.
int steps_of_move(const Places& places, int first, const PmacSettings& settings) {
    constexpr double counts = 0.25;
    constexpr int most = 200;
    constexpr double infinite = std::numeric_limits<double>::infinity();
    const kinematics::AxisPositions& from = places[static_cast<std::size_t>(first)];
    kinematics::AxisPositions least = kinematics::AxisPositions::Constant(from.size(), -infinite);
    kinematics::AxisPositions greatest = kinematics::AxisPositions::Constant(from.size(), infinite);
    const int last = std::min(first + most, static_cast<int>(std::ssize(places)) - 1);
    int longest = 1;
    for (int n = first + 1; n <= last; ++n) {
        const kinematics::AxisPositions& to = places[static_cast<std::size_t>(n)];
        const double steps = n - first;
        bool inside = true, open = true;
        for (Eigen::Index axis = 0; axis < from.size(); ++axis) {
            const double scale = settings.axes[static_cast<std::size_t>(axis)].counts_per_degree;
            const double slack = counts / scale / steps;
            const double slope = (to[axis] - from[axis]) / steps;
            inside = inside && slope >= least[axis] && slope <= greatest[axis];
            least[axis] = std::max(least[axis], slope - slack);
            greatest[axis] = std::min(greatest[axis], slope + slack);
            open = open && least[axis] <= greatest[axis];
        }
        longest = inside ? n - first : longest;
        if (!open) {
            break;
        }
    }
    return longest;
}

/// The places at which moves end.
std::vector<int> ends_of_moves(const Places& places, const PmacSettings& settings) {
    std::vector<int> ends;
    for (int at = 0; at + 1 < static_cast<int>(std::ssize(places));) {
        at += steps_of_move(places, at, settings);
        ends.push_back(at);
    }
    return ends;
}

std::string goal_line(const kinematics::AxisPositions& place, const PmacSettings& settings) {
    std::string line;
    for (Eigen::Index axis = 0; axis < place.size(); ++axis) {
        const char letter = settings.axes[static_cast<std::size_t>(axis)].letter;
        line += fmt::format("{}{}{:.5f}", axis == 0 ? "" : " ", letter, place[axis]);
    }
    return line;
}

} // namespace

std::vector<std::string>
pmac_program(const motion::Trajectory& motion, const PmacSettings& settings, double step) {
    expects(step > 0.0, "a step of time");
    const auto driven = static_cast<Eigen::Index>(settings.axes.size());
    refuse_undriven(motion, driven, step);
    const int steps = std::max(1, static_cast<int>(std::min(1e9, std::ceil(motion.duration() / step))));
    const double even = std::max(1e-3, motion.duration() / steps);
    const Places places = places_of(motion, driven, steps);
    const std::vector<int> ends = ends_of_moves(places, settings);
    if (std::ssize(ends) > most_pmac_moves) {
        throw Error(fmt::format("the motion of {:.0f} s needs {} moves, but the card's memory holds only {}",
                                motion.duration(),
                                ends.size(),
                                most_pmac_moves),
                    {},
                    "send it in parts, or use a larger tolerance");
    }
    std::string axes;
    for (const PmacAxis& axis : settings.axes) {
        axes += fmt::format("{}{}", axes.empty() ? "" : ",", axis.letter);
    }
    std::vector<std::string> lines{
        "LINEAR", "ABS", fmt::format("FRAX({})", axes), "TS0", fmt::format("TA{:.4f}", even * ms)};
    int before = 0, lasted = 0;
    for (const int end : ends) {
        if (end - before != lasted) {
            lasted = end - before;
            lines.push_back(fmt::format("TM{:.4f}", lasted * even * ms));
        }
        lines.push_back(goal_line(places[static_cast<std::size_t>(end)], settings));
        before = end;
    }
    return lines;
}

std::vector<double> line_ends(const std::vector<std::string>& lines) {
    constexpr std::string_view time_word = "TM";
    std::vector<double> ends;
    ends.reserve(lines.size());
    double lasts = 0.0, time = 0.0;
    for (const std::string& line : lines) {
        if (line.starts_with(time_word)) {
            (void)std::from_chars(line.data() + time_word.size(), line.data() + line.size(), lasts);
        } else if (line.size() > 1 &&
                   std::string_view("-0123456789").find(line[1]) != std::string_view::npos) {
            time += lasts / ms; // a goal: an axis and its number
        }
        ends.push_back(time);
    }
    return ends;
}

} // namespace millwright::pmac
