#include "core/gcode/plot_program.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace millwright::gcode {
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
            add(BlockKind::comment).text = line;
        }
    }

    Program build(const plot::CutPath& path) {
        if (path.size() > most_program_points) {
            throw Error(
                fmt::format(
                    "a program of {} points; more than {} million would take more memory than is kept "
                    "for it",
                    path.size(),
                    most_program_points / 1'000'000),
                {},
                "take a larger step-over or pitch, fewer pixels or passes, or a part of the drawing");
        }
        constexpr std::size_t others = 8; // up, spindle, end
        program_.blocks.reserve(program_.blocks.size() + path.size() + others);
        if (!path.empty()) {
            // Up first: nobody knows what stands between the tool and the first stroke.
            move({.at = {0.0, 0.0, path.front().at.z()}}, AxisSet::only(index_[2]));
            spindle(true);
        }
        bool first = true;
        for (const plot::CutPoint& point : path) {
            ++point_;
            expects(is_finite(point.at), "a point of a plot's path is finite");
            if (point.move == plot::CutMove::tool_change) {
                change_tool(point.tool);
                continue;
            }
            move(point, std::exchange(first, false) ? across() : AxisSet::all(3));
        }
        spindle(false);
        add(BlockKind::end);
        return std::move(program_);
    }

private:
    Block& add(BlockKind kind) {
        Block block;
        block.kind = kind;
        block.target = at_;
        block.path_point = point_;
        return program_.blocks.emplace_back(std::move(block));
    }

    [[nodiscard]] AxisSet across() const {
        AxisSet set = AxisSet::only(index_[0]);
        set.insert(index_[1]);
        return set;
    }

    void spindle(bool on) {
        if (settings_.spindle_rpm > 0.0) {
            add(on ? BlockKind::spindle_on : BlockKind::spindle_off).spindle_rpm =
                on ? settings_.spindle_rpm : 0.0;
        }
    }

    void change_tool(int tool) {
        spindle(false);
        add(BlockKind::pause).text = fmt::format("change to tool {}", tool);
        spindle(true);
    }

    static MoveRole role_of(plot::CutMove move) {
        switch (move) {
        case plot::CutMove::plunge:
            return MoveRole::plunge;
        case plot::CutMove::cut:
            return MoveRole::cut;
        case plot::CutMove::retract:
            return MoveRole::retract;
        case plot::CutMove::rapid:
        case plot::CutMove::tool_change:
            return MoveRole::link;
        }
        return MoveRole::none;
    }

    bool tells_a_new_axis(const AxisSet& named) {
        bool is_new = false;
        for (const int axis : index_) {
            is_new = is_new || (named.contains(axis) && !told_.contains(axis));
            if (named.contains(axis)) {
                told_.insert(axis);
            }
        }
        return is_new;
    }

    void move(const plot::CutPoint& point, AxisSet named) {
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
        Block& block = add(point.speed > 0.0 ? BlockKind::feed : BlockKind::rapid);
        block.role = role_of(point.move);
        block.named = named;
        if (point.speed > 0.0) {
            block.feed = point.speed;
            block.duration = distance / point.speed;
        }
    }

    const PlotProgramSettings& settings_;
    double unit_;
    Program program_;
    kinematics::AxisPositions at_;
    std::array<int, 3> index_{}; ///< of X, Y and Z
    int point_ = -1;
    AxisSet told_; ///< axes that some move has named: where the others stand nobody knows
};

} // namespace

std::string plot_axes(const kinematics::MachineModel& machine) {
    std::string letters;
    for (const kinematics::MachineAxis& axis : machine.axes()) {
        letters += axis.letter;
    }
    std::string sorted = letters;
    std::ranges::sort(sorted);
    if (sorted != "XYZ") {
        throw Error(
            fmt::format("machine '{}' has the axes {}; plots and pictures are cut by X, Y and Z alone",
                        machine.name(),
                        letters));
    }
    return letters;
}

Program plot_program(const plot::CutPath& path, const PlotProgramSettings& settings) {
    return PlotProgramBuilder(settings).build(path);
}

} // namespace millwright::gcode
