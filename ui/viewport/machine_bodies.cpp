#include "ui/viewport/machine_bodies.h"

#include "core/kinematics/forward.h"
#include "core/kinematics/machine_solids.h"

namespace millwright::viewport {

namespace {

/// By which the tool in the spindle is longer than the one that the bodies show, from its tip on.
Vec3 longer_tool(const kinematics::MachineModel& machine) {
    const kinematics::MachineDescription& description = machine.description();
    return description.tool_length_offset * description.tool_axis;
}

/// The body's frame with all axes at their physical zero.
Frame at_zero(const kinematics::MachineBody& body) {
    Frame pose = Frame::Identity();
    pose.translation() = body.center;
    if (body.shape == kinematics::MachineBody::Shape::cylinder) {
        pose.linear() = frame_along(body.direction);
    }
    return pose;
}

} // namespace

std::vector<Frame> body_poses(const kinematics::MachineModel& machine,
                              const kinematics::AxisPositions& positions) {
    std::vector<Frame> poses;
    for (const kinematics::MachineBody& body : machine.description().bodies) {
        Frame pose = at_zero(body);
        if (is_cutter(machine, body)) {
            pose.pretranslate(-longer_tool(machine));
        }
        poses.push_back(kinematics::carrier_motion(machine, positions, body.carried_by) * pose);
    }
    return poses;
}

Box3 body_box(const kinematics::MachineBody& body) {
    const Vec3 half = 0.5 * body.size;
    return {Vec3(-half), half};
}

} // namespace millwright::viewport
