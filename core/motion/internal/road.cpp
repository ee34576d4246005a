#include "core/motion/internal/road.h"

#include "core/base/error.h"
#include "core/kinematics/forward.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace millwright::motion::internal {

namespace {

using gcode::Block;
using gcode::BlockKind;
using gcode::Program;
using kinematics::AxisPositions;
using kinematics::MachineModel;

void check_axes(const Program& program, const MachineModel& machine) {
    std::string wanted;
    std::string there;
    bool same = static_cast<int>(program.axes.size()) == machine.axis_count();
    for (const gcode::ProgramAxis& axis : program.axes) {
        wanted += axis.letter;
        const int n = machine.axis_index(axis.letter);
        same = same && n == static_cast<int>(wanted.size()) - 1 && machine.axis(n).kind == axis.kind;
    }
    for (const kinematics::MachineAxis& axis : machine.axes()) {
        there += axis.letter;
    }
    if (!same) {
        throw Error(fmt::format("the program is for axes {} of '{}', the machine '{}' has {}",
                                wanted,
                                program.machine,
                                machine.name(),
                                there));
    }
}

bool keeps_moving(BlockKind kind) {
    return kind == BlockKind::comment || kind == BlockKind::rapid || kind == BlockKind::feed;
}

AxisPositions position_after(const Block& block, const AxisPositions& before) {
    if (!block.moves()) {
        return before;
    }
    AxisPositions after = before;
    for (int n = 0; n < static_cast<int>(after.size()); ++n) {
        if (block.named.contains(n)) {
            after[n] = block.target[n];
        }
    }
    expects(after.allFinite(), "the target of a block is finite");
    return after;
}

class Builder {
public:
    Builder(const MachineModel& machine, const PlannerSettings& settings, const AxisPositions& start)
        : machine_(machine), settings_(settings), direction_(AxisPositions::Zero(start.size())),
          last_tip_(kinematics::forward(machine, start).tip) {
        path_.positions.push_back(start);
        path_.part_length.push_back(0.0);
    }

    void reserve(std::size_t blocks) {
        path_.positions.reserve(blocks + 1);
        path_.part_length.reserve(blocks + 1);
        path_.segments.reserve(blocks);
    }

    void add(const Block& block) {
        const AxisPositions before = path_.positions.back();
        const AxisPositions after = position_after(block, before);
        Segment segment;
        if (block.kind == BlockKind::dwell) {
            segment.standing_time = block.duration;
        }
        if (!keeps_moving(block.kind)) {
            speed_before_ = 0.0;
        }
        const AxisPositions step = after - before;
        if (step.cwiseAbs().maxCoeff() > 0.0) {
            move(segment, step, block);
        }
        path_.segments.push_back(segment);
        path_.positions.push_back(after);
        add_part_length(after, segment.length > 0.0);
    }

    Path take() { return std::move(path_); }

private:
    const MachineModel& machine_;
    const PlannerSettings& settings_;
    Path path_;
    AxisPositions direction_;   ///< of the last move, scaled, unit
    double speed_before_ = 0.0; ///< top speed of the last move; 0 after a stop
    Vec3 last_tip_;

    void move(Segment& segment, const AxisPositions& step, const Block& block) {
        AxisPositions direction = step;
        for (int n = 0; n < machine_.axis_count(); ++n) {
            direction[n] = step[n] / machine_.axis(n).max_acceleration;
        }
        segment.length = direction.norm();
        direction /= segment.length;
        set_limits(segment, direction, block);
        const double corner = std::min(corner_speed(direction), speed_before_);
        segment.max_start_speed = std::min(corner, segment.max_speed);
        direction_ = direction;
        speed_before_ = settings_.corners == Corners::exact_stop ? 0.0 : segment.max_speed;
    }

    void set_limits(Segment& segment, const AxisPositions& direction, const Block& block) const {
        segment.max_speed = std::numeric_limits<double>::infinity();
        if (block.kind == BlockKind::feed && block.duration > 0.0) {
            segment.max_speed = segment.length / block.duration;
        }
        segment.max_acceleration = std::numeric_limits<double>::infinity();
        for (int n = 0; n < machine_.axis_count(); ++n) {
            const double share = std::abs(direction[n]);
            if (!(share > 0.0)) {
                continue;
            }
            const kinematics::MachineAxis& axis = machine_.axis(n);
            const double speed = axis.max_velocity / axis.max_acceleration / share;
            if (speed < segment.max_speed) {
                segment.max_speed = speed;
                segment.velocity_axis = n;
            }
            if (1.0 / share < segment.max_acceleration) {
                segment.max_acceleration = 1.0 / share;
                segment.acceleration_axis = n;
            }
        }
    }

    /// In a corner each scaled velocity jumps by speed * |change of direction|, allowed is corner_time.
    [[nodiscard]] double corner_speed(const AxisPositions& direction) const {
        const double turn = (direction - direction_).cwiseAbs().maxCoeff();
        constexpr double straight = 1e-15; // rounding of a unit vector
        return turn > straight ? settings_.corner_time / turn : std::numeric_limits<double>::infinity();
    }

    void add_part_length(const AxisPositions& position, bool moved) {
        double length = path_.part_length.back();
        if (moved) {
            const Vec3 tip = kinematics::forward(machine_, position).tip;
            length += (tip - last_tip_).norm();
            last_tip_ = tip;
        }
        path_.part_length.push_back(length);
    }
};

} // namespace

Path lay_out(const Program& program,
             const MachineModel& machine,
             const PlannerSettings& settings,
             const AxisPositions& start,
             const Progress& progress) {
    check_axes(program, machine);
    expects(start.size() == machine.axis_count() && start.allFinite(),
            "a start has a finite position an axis");
    expects(settings.corner_time >= 0.0, "a corner time is not negative");
    Builder builder(machine, settings, start);
    builder.reserve(program.blocks.size());
    constexpr std::size_t blocks_between_looks = 4096; // about 1 ms
    for (std::size_t n = 0; n < program.blocks.size(); ++n) {
        if (n % blocks_between_looks == 0) {
            progress.check();
            progress.report(static_cast<double>(n) / static_cast<double>(program.blocks.size()));
        }
        builder.add(program.blocks[n]);
    }
    return builder.take();
}

} // namespace millwright::motion::internal
