#include "core/plot/plot_program.h"

#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/base/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string_view>
#include <utility>

namespace millwright::plot {
namespace {

class PlotProgramBuilder {
public:
    explicit PlotProgramBuilder(const PlotProgramSettings& settings)
        : settings_(settings), unit_(std::pow(10.0, -settings.length_decimals)) {
        program_.machine = settings.machine;
        for (std::size_t n = 0; n < index_.size(); ++n) {
            const std::size_t found = settings.axes.find("XYZ"[n]);
            expects(settings.axes.size() == index_.size() && found != std::string::npos,
                    "a plot is cut by the axes X, Y and Z");
            index_[n] = static_cast<int>(found);
            program_.axes.push_back({.letter = settings.axes[n]});
        }
        program_.start = kinematics::AxisPositions::Zero(3);
        at_ = program_.start;
        for (const std::string& line : settings.header) {
            add(program::BlockKind::comment).text = line;
        }
    }

    program::Program build(const CutPath& path) {
        if (path.size() > most_program_points) {
            throw Error(
                fmt::format("the program has {} points, but more than {} million would need too much memory",
                            path.size(),
                            most_program_points / 1'000'000),
                {},
                "use a larger step-over or pitch, fewer pixels or passes, or part of the drawing");
        }
        constexpr std::size_t others = 8; // up, spindle, end
        program_.blocks.reserve(program_.blocks.size() + path.size() + others);
        if (!path.empty()) {
            begin_with(path);
            name_cutters(path);
        }
        bool first = true;
        for (const CutPoint& point : path) {
            ++point_;
            expects(is_finite(point.at), "a point of a plot's path is finite");
            if (point.move == CutMove::tool_change) {
                change_tool(point.tool);
                continue;
            }
            move(point, std::exchange(first, false) ? across() : program::AxisSet::all(3));
        }
        spindle(false);
        add(program::BlockKind::end);
        return std::move(program_);
    }

private:
    program::Block& add(program::BlockKind kind) {
        program::Block block;
        block.kind = kind;
        block.target = at_;
        block.path_point = point_;
        return program_.blocks.emplace_back(std::move(block));
    }

    [[nodiscard]] program::AxisSet across() const {
        program::AxisSet set = program::AxisSet::only(index_[0]);
        set.insert(index_[1]);
        return set;
    }

    void spindle(bool on) {
        if (settings_.spindle_rpm > 0.0) {
            add(on ? program::BlockKind::spindle_on : program::BlockKind::spindle_off).spindle_rpm =
                on ? settings_.spindle_rpm : 0.0;
        }
    }

    /// The first tool, then up: what stands between the tool and the first stroke is unknown.
    void begin_with(const CutPath& path) {
        const bool changes = std::ranges::any_of(
            path, [](const CutPoint& point) { return point.move == CutMove::tool_change; });
        const std::string tool = fmt::format("tool {}", path.front().tool);
        if (changes) { // another may be in the spindle from the last time
            add(program::BlockKind::pause).text = "put in " + tool;
        } else {
            add(program::BlockKind::comment).text = tool;
        }
        move({.at = {0.0, 0.0, path.front().at.z()}}, program::AxisSet::only(index_[2]));
        spindle(true);
    }

    void name_cutters(const CutPath& path) {
        std::set<int> tools;
        for (const CutPoint& point : path) {
            const bool first = tools.insert(point.tool).second;
            if (first && settings_.tips) {
                add_cutter(point.tool, settings_.tips->of(point.tool));
            }
        }
    }

    /// A point has no diameter.
    void add_cutter(int tool, const ToolTip& tip) {
        program::ProgramCutter cutter{.number = tool, .diameter = tip.diameter, .corner_radius = 0.0};
        switch (tip.kind) {
        case TipKind::point:
            return;
        case TipKind::flat:
            cutter.kind = "flat end mill";
            break;
        case TipKind::ball:
            cutter.corner_radius = tip.diameter / 2.0;
            cutter.kind = "ball end mill";
            break;
        case TipKind::v:
            cutter.half_angle = tip.angle / 2.0;
            cutter.corner_radius = tip.end_radius;
            cutter.tip_diameter = tip.end_width;
            cutter.kind = "engraving tool";
            break;
        }
        program_.cutters.push_back(std::move(cutter));
    }

    void change_tool(int tool) {
        spindle(false);
        add(program::BlockKind::pause).text = fmt::format("change to tool {}", tool);
        spindle(true);
    }

    static program::MoveRole role_of(CutMove move) {
        switch (move) {
        case CutMove::plunge:
            return program::MoveRole::plunge;
        case CutMove::cut:
            return program::MoveRole::cut;
        case CutMove::retract:
            return program::MoveRole::retract;
        case CutMove::rapid:
        case CutMove::tool_change:
            return program::MoveRole::link;
        }
        return program::MoveRole::none;
    }

    bool tells_a_new_axis(const program::AxisSet& named) {
        bool is_new = false;
        for (const int axis : index_) {
            is_new = is_new || (named.contains(axis) && !told_.contains(axis));
            if (named.contains(axis)) {
                told_.insert(axis);
            }
        }
        return is_new;
    }

    void move(const CutPoint& point, program::AxisSet named) {
        kinematics::AxisPositions target = at_;
        for (int n = 0; n < 3; ++n) {
            const int axis = index_[static_cast<std::size_t>(n)];
            if (named.contains(axis)) {
                target[axis] = std::round(point.at[n] / unit_) * unit_;
            }
        }
        const double distance = (target - at_).norm();
        if (!tells_a_new_axis(named) && !(distance > 0.0)) {
            return;
        }
        at_ = target;
        program::Block& block = add(point.speed > 0.0 ? program::BlockKind::feed : program::BlockKind::rapid);
        block.role = role_of(point.move);
        block.named = named;
        if (point.speed > 0.0) {
            block.feed = point.speed;
            block.duration = distance / point.speed;
        }
    }

    const PlotProgramSettings& settings_;
    double unit_;
    program::Program program_;
    kinematics::AxisPositions at_;
    std::array<int, 3> index_{}; ///< of X, Y and Z
    int point_ = -1;
    program::AxisSet told_; ///< axes that some move has named: where the others are is not known
};

} // namespace

namespace {

/// So far that all from `low` to `high` is inside of the axis, where it has the room.
double shift_into(const kinematics::MachineAxis& axis, double low, double high) {
    constexpr double steps = 1e3; // a thousandth of a millimetre, away from the limit
    return (std::ceil(std::max(0.0, axis.min - low) * steps) -
            std::ceil(std::max(0.0, high - axis.max) * steps)) /
           steps;
}

} // namespace

void expect_on_table(const CutPath& path, const kinematics::MachineModel& machine, const Vec2& origin) {
    if (path.empty()) {
        return;
    }
    Vec3 low = path.front().at;
    Vec3 high = low;
    for (const CutPoint& point : path) {
        low = low.cwiseMin(point.at);
        high = high.cwiseMax(point.at);
    }
    Vec2 better = origin;
    std::string fault;
    bool fits = true;
    for (const kinematics::MachineAxis& axis : machine.axes()) {
        const auto n = static_cast<Eigen::Index>(std::string_view("XYZ").find(axis.letter));
        if (n < 0 || n > 1) {
            continue;
        }
        constexpr double rounding = 1e-4; // of a program's targets
        const bool below = low[n] < axis.min - rounding;
        if (fault.empty() && (below || high[n] > axis.max + rounding)) {
            fault = fmt::format("axis {} would have to move to {:.3f}, outside {:.3f} ... {:.3f} mm",
                                axis.letter,
                                below ? low[n] : high[n],
                                axis.min,
                                axis.max);
        }
        better[n] += shift_into(axis, low[n], high[n]);
        fits = fits && high[n] - low[n] <= axis.max - axis.min;
    }
    if (fault.empty()) {
        return;
    }
    const Vec3 size = high - low;
    const std::string hint =
        fits ? fmt::format("set the origin to {0:.3f}, {1:.3f}: Origin X and Y in the window, --origin "
                           "{0:.3f},{1:.3f}",
                           better.x(),
                           better.y())
             : fmt::format("use a larger machine, or a smaller drawing: it is {:.1f} x {:.1f} mm",
                           size.x(),
                           size.y());
    throw Error(fault, {}, hint);
}

std::optional<Diagnostic> speeds_not_reached(const CutPath& path, const kinematics::MachineModel& machine) {
    std::optional<Diagnostic> first;
    std::size_t count = 0;
    Vec3 from = path.empty() ? Vec3(Vec3::Zero()) : path.front().at;
    for (const CutPoint& point : path) {
        const Vec3 way = point.at - from;
        from = point.at;
        const double length = way.norm();
        for (const kinematics::MachineAxis& axis : machine.axes()) {
            const std::size_t n = std::string_view("XYZ").find(axis.letter);
            constexpr double rounding = 1.0 + 1e-6;
            if (n == std::string_view::npos || !(length > 0.0) ||
                !(point.speed * std::abs(way[static_cast<Eigen::Index>(n)]) >
                  axis.max_velocity * length * rounding)) {
                continue;
            }
            if (++count == 1) {
                first = {{},
                         fmt::format("{:.0f} mm/min exceeds the maximum speed of {}: its axis {} is limited "
                                     "to {:.0f} mm/min",
                                     to_mm_per_min(point.speed),
                                     machine.name(),
                                     axis.letter,
                                     to_mm_per_min(axis.max_velocity)),
                         "the machine will be slower"};
            }
            break;
        }
    }
    if (count > 1) {
        first->message += fmt::format("; the same applies to {} more", counted(count - 1, "move"));
    }
    return first;
}

std::string plot_axes(const kinematics::MachineModel& machine) {
    std::string letters;
    for (const kinematics::MachineAxis& axis : machine.axes()) {
        letters += axis.letter;
    }
    std::string sorted = letters;
    std::ranges::sort(sorted);
    if (sorted != "XYZ") {
        throw Error(fmt::format(
            "machine '{}' has the axes {}, but plots and pictures can only be cut with X, Y and Z",
            machine.name(),
            letters));
    }
    return letters;
}

program::Program plot_program(const CutPath& path, const PlotProgramSettings& settings) {
    return PlotProgramBuilder(settings).build(path);
}

} // namespace millwright::plot
