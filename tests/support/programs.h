// Tool paths and programs for tests, made by hand: zigzag along v over a uniform grid of a preset.
#pragma once

#include "core/geometry/presets.h"
#include "core/kinematics/inverse.h"
#include "core/program/post.h"
#include "core/program/program.h"
#include "core/toolpath/toolpath.h"
#include "tests/support/machines.h"

#include <string_view>

namespace millwright::test {

inline toolpath::Toolpath zigzag_over(std::string_view preset, int nu, int nv) {
    const geometry::Surface surface = geometry::surface_preset(preset).make();
    const geometry::BezierPatch& patch = surface.patch(geometry::PatchId{0});
    toolpath::Toolpath path;
    for (int i = 0; i < nu; ++i) {
        for (int k = 0; k < nv; ++k) {
            const int j = i % 2 == 0 ? k : nv - 1 - k;
            const Vec2 uv(static_cast<double>(i) / (nu - 1), static_cast<double>(j) / (nv - 1));
            const auto derivatives = patch.derivatives(uv.x(), uv.y());
            const Vec3 normal = derivatives.du.cross(derivatives.dv).normalized();
            const auto kind = i == 0 && k == 0 ? toolpath::MoveKind::start
                              : k == 0         ? toolpath::MoveKind::cross
                                               : toolpath::MoveKind::track;
            path.points.push_back({{derivatives.position, normal}, kind, {i, j, uv}});
        }
    }
    return path;
}

inline toolpath::AxisPath axes_for(const kinematics::MachineModel& machine, const toolpath::Toolpath& path) {
    toolpath::AxisPath axes;
    kinematics::AxisPositions previous = kinematics::AxisPositions::Zero(machine.axis_count());
    for (const toolpath::PathPoint& point : path.points) {
        const auto solution = kinematics::inverse(machine, point.pose, previous);
        previous = kinematics::nearest_branch(machine, solution.branches, previous);
        axes.positions.push_back(previous);
    }
    return axes;
}

/// The program of a preset on a shipped machine.
inline program::PostResult post_over(std::string_view preset,
                                     const kinematics::MachineModel& machine,
                                     int nu,
                                     int nv,
                                     const program::ProgramSettings& settings = {}) {
    const toolpath::Toolpath path = zigzag_over(preset, nu, nv);
    return program::post(machine, path, axes_for(machine, path), settings, {{"project", "test"}});
}

/// Adds a straight move to a program; `duration` is that of a feed, 0 makes it a rapid.
inline void
add_move(program::Program& program, const kinematics::AxisPositions& target, double duration = 0.0) {
    program::Block& block = program.blocks.emplace_back();
    block.kind = duration > 0.0 ? program::BlockKind::feed : program::BlockKind::rapid;
    block.target = target;
    block.named = program::AxisSet::all(static_cast<int>(target.size()));
    block.duration = duration;
}

inline void add_block(program::Program& program, program::BlockKind kind) {
    const kinematics::AxisPositions where = program::position_before(program, program.block_count());
    program::Block& block = program.blocks.emplace_back();
    block.kind = kind;
    block.target = where;
}

inline program::Program empty_program(const kinematics::MachineModel& machine) {
    program::Program program;
    program.machine = machine.name();
    for (const kinematics::MachineAxis& axis : machine.axes()) {
        program.axes.push_back({axis.letter, axis.kind});
    }
    program.start = kinematics::AxisPositions::Zero(machine.axis_count());
    return program;
}

} // namespace millwright::test
