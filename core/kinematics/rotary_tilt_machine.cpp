#include "core/kinematics/rotary_tilt_machine.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/base/units.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>

namespace millwright::kinematics {

namespace {

constexpr double same_mm = 1e-9;
constexpr double same_angle = 1e-9; // rad, or of a unit vector

bool lies_at(const Vec3& a, const Vec3& b) {
    return (a - b).cwiseAbs().maxCoeff() <= same_mm;
}

bool goes_along(const MachineAxis& axis, char letter, AxisKind kind, const Vec3& direction) {
    return axis.letter == letter && axis.kind == kind && lies_at(axis.direction, direction);
}

/// A point on a rotary axis can lie anywhere along it.
bool passes_through(const MachineAxis& axis, const Vec3& point) {
    return (axis.point - point).cross(axis.direction).norm() <= same_mm;
}

} // namespace

std::optional<RotaryTilt> rotary_tilt_of(const MachineModel& machine) {
    const MachineDescription& of = machine.description();
    if (of.angle_formulas != AngleFormulas::rotary_tilt || of.table.size() != 2 || of.head.size() != 3) {
        return std::nullopt;
    }
    const MachineAxis &tilt = of.table[0], &rotary = of.table[1];
    const double e = of.table_origin.x();
    const bool axes =
        goes_along(tilt, 'B', AxisKind::rotary, Vec3::UnitY()) && passes_through(tilt, Vec3::Zero()) &&
        std::abs(tilt.zero_offset + pi / 2.0) <= same_angle &&
        goes_along(rotary, 'A', AxisKind::rotary, Vec3::UnitZ()) &&
        passes_through(rotary, Vec3(e, 0.0, 0.0)) && std::abs(rotary.zero_offset) <= same_angle &&
        goes_along(of.head[0], 'X', AxisKind::linear, Vec3::UnitX()) &&
        goes_along(of.head[1], 'Y', AxisKind::linear, -Vec3::UnitY()) &&
        goes_along(of.head[2], 'Z', AxisKind::linear, Vec3::UnitZ());
    const bool points = lies_at(of.table_origin, Vec3(e, 0.0, of.table_origin.z())) &&
                        lies_at(of.tool_tip, Vec3(0.0, 0.0, of.tool_tip.z())) &&
                        lies_at(of.tool_axis, Vec3::UnitZ());
    if (!axes || !points) {
        return std::nullopt;
    }
    const double OF = of.tip_to_base.value_or(0.0) + of.tool_length_offset;
    return RotaryTilt{.a = of.workpiece_offset.x(),
                      .b = of.workpiece_offset.y(),
                      .c = of.workpiece_offset.z(),
                      .e = e,
                      .AB = -of.table_origin.z(),
                      .B4 = of.tool_tip.z() + OF,
                      .OF = OF};
}

MachineModel with_rotary_tilt(const MachineModel& machine, const RotaryTilt& constants) {
    if (!rotary_tilt_of(machine)) {
        throw Error(fmt::format(
            "machine '{}' is not a rotary-tilt table like that of the thesis: it has no e, OF, AB and B4",
            machine.name()));
    }
    MachineDescription changed = machine.description();
    changed.workpiece_offset = Vec3(constants.a, constants.b, constants.c);
    changed.table[1].point = Vec3(constants.e, 0.0, 0.0);
    changed.table_origin = Vec3(constants.e, 0.0, -constants.AB);
    changed.tool_tip = Vec3(0.0, 0.0, constants.B4 - constants.OF);
    changed.tip_to_base = constants.OF - changed.tool_length_offset;
    return MachineModel(std::move(changed));
}

} // namespace millwright::kinematics
