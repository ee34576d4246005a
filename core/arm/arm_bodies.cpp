#include "core/arm/arm_bodies.h"

#include "core/arm/arm_forward.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/units.h"
#include "core/geometry/glb.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::arm {

namespace {

/// The plane in which links 2 and 3 move: x forward, z up, y along the axis of joint 2.
struct ArmPlane {
    Vec3 shoulder, forward, up, across;

    [[nodiscard]] Vec3 at(double angle, double distance) const {
        return shoulder + distance * (std::cos(angle) * forward + std::sin(angle) * up);
    }
    /// How high a direction in the plane points.
    [[nodiscard]] double elevation(const Vec3& direction) const {
        return std::atan2(direction.dot(up), direction.dot(forward));
    }
};

ArmPlane plane_of(const std::vector<Frame>& joints) {
    return {joints[1].translation(),
            joints[0].linear().col(0),
            joints[0].linear().col(2),
            joints[1].linear().col(2)};
}

/// Where a linear drive is fixed, and where it pulls.
struct DriveEnds {
    Vec3 fixed, pulling;
};

DriveEnds ends_of(const ArmActuators& actuators, const std::vector<Frame>& joints, int drive) {
    const ArmPlane plane = plane_of(joints);
    const Linkage& linkage = drive == 2 ? actuators.second : actuators.third;
    const double down = -0.5 * pi - std::atan2(linkage.phi, linkage.gamma); // the leg gamma hangs down
    const Frame& link = joints[static_cast<std::size_t>(drive) - 1];
    const double elevation = plane.elevation(link.linear().col(0));
    const double lever = drive == 2 ? elevation + linkage.omega : elevation + pi; // 3: behind the shoulder
    return {plane.at(down, linkage.alpha()), plane.at(lever, linkage.beta)};
}

Frame frame_of(const Vec3& origin, const Mat3& directions) {
    Frame frame = Frame::Identity();
    frame.translation() = origin;
    frame.linear() = directions;
    return frame;
}

Frame along_drive(const DriveEnds& ends, const Vec3& across, const Vec3& origin) {
    const Vec3 way = ends.pulling - ends.fixed;
    const double length = way.norm();
    const Vec3 z = length > 0.0 ? Vec3(way / length) : across.unitOrthogonal();
    Mat3 directions;
    directions << across.cross(z), across, z;
    return frame_of(origin, directions);
}

Frame drive_part(const ArmActuators& actuators, const std::vector<Frame>& joints, const ArmPart& part) {
    const int drive =
        part.carrier == ArmCarrier::cylinder || part.carrier == ArmCarrier::rod ? part.number : 3;
    const DriveEnds ends = ends_of(actuators, joints, drive);
    const Vec3 across = joints[1].linear().col(2);
    switch (part.carrier) {
    case ArmCarrier::cylinder:
        return along_drive(ends, across, ends.fixed);
    case ArmCarrier::rod:
        return along_drive(ends, across, ends.pulling);
    case ArmCarrier::lever:
        return frame_of(joints[1].translation(), joints[2].linear());
    default:
        return frame_of(ends.pulling, joints[1].linear());
    }
}

} // namespace

std::vector<geometry::SolidBody> read_bodies(const ArmBodies& bodies) {
    std::vector<geometry::SolidBody> all = geometry::parse_glb(read_file(bodies.file), bodies.file);
    std::vector<geometry::SolidBody> chosen;
    for (const ArmPart& part : bodies.parts) {
        const auto found = std::ranges::find(all, part.node, &geometry::SolidBody::name);
        if (found == all.end()) {
            throw Error(fmt::format("there is no node '{}' with triangles", part.node), bodies.file);
        }
        chosen.push_back(*found);
    }
    return chosen;
}

std::vector<Frame> base_T_parts(const ArmModel& arm,
                                const std::optional<ArmActuators>& actuators,
                                const std::vector<ArmPart>& parts,
                                const JointPositions& positions) {
    const std::vector<Frame> joints = base_T_joints(arm, positions);
    std::vector<Frame> all;
    for (const ArmPart& part : parts) {
        if (part.carrier == ArmCarrier::base) {
            all.push_back(Frame::Identity());
        } else if (part.carrier == ArmCarrier::joint) {
            expects(part.number >= 0 && part.number < std::ssize(joints), "the joint of a body exists");
            all.push_back(joints[static_cast<std::size_t>(part.number)]);
        } else {
            expects(actuators && arm.planar_elbow(), "a body of a drive belongs to an arm with drives");
            all.push_back(drive_part(*actuators, joints, part));
        }
    }
    return all;
}

} // namespace millwright::arm
