#include "ui/workspaces/file_place.h"

#include "core/base/error.h"
#include "core/kinematics/forward.h"
#include "core/kinematics/inverse.h"

#include <algorithm>
#include <cmath>

namespace millwright::actions {

namespace {

using gcode::PathPlace;
using gcode::Step;
using plan::OpenedProgram;
using plan::PlannedMotion;

/// First block of `step`, and one past its last.
std::pair<int, int> blocks_of(const PlannedMotion& motion, Step step) {
    const auto [first, last] =
        std::equal_range(motion.step_of_block.begin(), motion.step_of_block.end(), step);
    return {static_cast<int>(first - motion.step_of_block.begin()),
            static_cast<int>(last - motion.step_of_block.begin())};
}

/// `share` of the points of `step` done.
PathPlace path_place(const OpenedProgram& opened, Step step, double share) {
    const auto [first, end] = opened.path.points_of(step);
    if (end <= first) {
        return {std::max<std::int64_t>(first - 1, 0), 1.0};
    }
    const double at = std::clamp(share, 0.0, 1.0) * static_cast<double>(end - first);
    const auto whole = std::min(static_cast<std::int64_t>(at), end - first - 1);
    return {first + whole, at - static_cast<double>(whole)};
}

kinematics::AxisPositions axes_at(const OpenedProgram& opened, const Vec3& tip, double time) {
    if (opened.motion) {
        return opened.motion->trajectory->at(time).position;
    }
    if (!opened.machine || opened.path.empty() || !opened.machine->rotary_axes().empty()) {
        return {};
    }
    const int count = opened.machine->axis_count();
    return kinematics::with_tip_at(*opened.machine, kinematics::AxisPositions::Zero(count), tip);
}

FilePlace made(const OpenedProgram& opened, Step step, const PathPlace& place, double time) {
    FilePlace found;
    found.step = step;
    found.line = opened.execution->line_of(step);
    found.moment.place = place;
    if (opened.path.point_count() > 0) {
        found.moment.tip = opened.path.position(place);
        std::tie(found.moment.first, found.moment.end) = opened.path.points_of(step);
    }
    found.axes = axes_at(opened, found.moment.tip, time);
    if (opened.motion) {
        found.moment.axis = kinematics::forward(*opened.machine, found.axes).axis;
    }
    return found;
}

PathPlace place_of_time(const OpenedProgram& opened, double time) {
    if (opened.path.empty()) {
        return {};
    }
    if (!opened.motion) {
        return opened.path.place_at(time);
    }
    const motion::Trajectory& planned = *opened.motion->trajectory;
    const motion::Sample sample = planned.at(time);
    const Step step = opened.motion->step_of_block[static_cast<std::size_t>(sample.block)];
    const auto [first, end] = blocks_of(*opened.motion, step);
    return path_place(opened, step, (sample.block - first + sample.fraction) / std::max(end - first, 1));
}

Step step_of_time(const OpenedProgram& opened, const PathPlace& place, double time) {
    if (opened.motion) {
        const int block = opened.motion->trajectory->block_at(time);
        return opened.motion->step_of_block[static_cast<std::size_t>(block)];
    }
    return opened.path.empty() ? 0 : opened.path.point(place.point).step();
}

} // namespace

double duration_of(const OpenedProgram& opened) {
    return opened.motion ? opened.motion->trajectory->duration() : opened.seconds;
}

std::optional<FilePlace> place_at(const OpenedProgram& opened, double time) {
    if (!opened.execution || opened.execution->count() == 0) {
        return std::nullopt;
    }
    const PathPlace place = place_of_time(opened, time);
    return made(opened, step_of_time(opened, place, time), place, time);
}

FilePlace place_in(const OpenedProgram& opened, Step step, double time) {
    expects(opened.execution && step < opened.execution->count(), "a step of the program");
    return made(opened, step, place_of_time(opened, time), time);
}

double time_of(const OpenedProgram& opened, Step step) {
    if (opened.motion) {
        const auto& steps = opened.motion->step_of_block;
        const auto block = std::lower_bound(steps.begin(), steps.end(), step);
        return block == steps.end()
                   ? duration_of(opened)
                   : opened.motion->trajectory->start_of(static_cast<int>(block - steps.begin()));
    }
    const auto [first, end] = opened.path.points_of(step);
    return opened.path.empty() || first >= opened.path.point_count() ? duration_of(opened)
                                                                     : time_of(opened, PathPlace{first, 0.0});
}

double time_of(const OpenedProgram& opened, const PathPlace& place) {
    if (!opened.motion) {
        return opened.path.time_of(place);
    }
    const Step step = opened.path.point(place.point).step();
    const auto [first, end] = opened.path.points_of(step);
    const auto [block, last] = blocks_of(*opened.motion, step);
    if (last <= block) {
        return time_of(opened, step);
    }
    const double share =
        (static_cast<double>(place.point - first) + place.fraction) / static_cast<double>(end - first);
    const double at = block + std::clamp(share, 0.0, 1.0) * (last - block);
    const int inside = std::min(static_cast<int>(at), last - 1);
    return opened.motion->trajectory->time_at(inside, at - inside);
}

std::optional<Step> moving_step(const OpenedProgram& opened, Step step, int direction) {
    const auto [first, end] = opened.path.points_of(step);
    if (direction > 0) {
        return end < opened.path.point_count() ? std::optional(opened.path.point(end).step()) : std::nullopt;
    }
    // Point 0 is where the program begins: nothing leads there.
    return first > 1 ? std::optional(opened.path.point(first - 1).step()) : std::nullopt;
}

} // namespace millwright::actions
