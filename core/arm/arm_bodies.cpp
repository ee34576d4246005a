#include "core/arm/arm_bodies.h"

#include "core/arm/arm_forward.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/units.h"
#include "core/geometry/glb.h"
#include "core/kinematics/machine_solids.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
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

namespace {

using geometry::Circle;
using geometry::Extent;
using geometry::hull_of;
using geometry::SolidMesh;

const Vec3 bronze(0.78, 0.60, 0.33), grip(0.20, 0.50, 0.62);

constexpr double least_link = 400.0;
constexpr double floor_z = -900.0; // below the shoulder

/// Across the arm, from its middle: what lies beside what.
constexpr double core_half = 36.0;
constexpr double plate_half = 58.0;
constexpr double inner_cheek = 90.0, inner_cheek_end = 126.0;
constexpr double coupler_near = 129.0, coupler_far = 141.0;
constexpr double lever_near = 143.0, lever_far = 179.0;
constexpr double drive_middle = 161.0;
constexpr double outer_cheek = 197.0, outer_cheek_end = 215.0;

SolidMesh hull(std::initializer_list<Circle> circles, double from, double to, const Vec3& color) {
    return hull_of(std::vector<Circle>(circles), Extent{from, to, 3.0}, color);
}

/// On both sides of the middle.
void add_pair(std::vector<SolidMesh>& to,
              std::initializer_list<Circle> circles,
              double near,
              double far,
              const Vec3& color) {
    to.push_back(hull(circles, near, far, color));
    to.push_back(hull(circles, -far, -near, color));
}

/// Coordinates whose xy lies in the plane of the arm (x forward, y up), z across it, in the frame of joint 1.
Frame upright() {
    Frame frame = Frame::Identity();
    frame.linear() << Vec3::UnitX(), Vec3::UnitZ(), -Vec3::UnitY();
    return frame;
}

Circle circle(double x, double y, double radius) {
    return {Vec2(x, y), radius};
}

/// Where the linear drives are fixed, in the plane of the arm.
Vec2 pivot(const Linkage& linkage) {
    return {-linkage.phi, -linkage.gamma};
}

std::vector<SolidMesh> base() {
    constexpr double corner = 230.0;
    return {hull({circle(corner, corner, 50.0),
                  circle(-corner, corner, 50.0),
                  circle(-corner, -corner, 50.0),
                  circle(corner, -corner, 50.0)},
                 floor_z,
                 floor_z + 28.0,
                 kinematics::graphite),
            hull({circle(0.0, 0.0, 235.0)}, floor_z + 28.0, -650.0, kinematics::paint),
            hull({circle(0.0, 0.0, 262.0)}, -650.0, -616.0, kinematics::graphite)};
}

std::vector<SolidMesh> column(const ArmActuators& drives) {
    std::vector<SolidMesh> flat;
    const Vec2 second = pivot(drives.second), third = pivot(drives.third);
    const std::initializer_list<Circle> cheek = {
        circle(0.0, 0.0, 88.0), circle(150.0, -530.0, 34.0), circle(-110.0, -530.0, 34.0)};
    add_pair(flat, cheek, inner_cheek, inner_cheek_end, kinematics::paint);
    const std::initializer_list<Circle> outside = {
        circle(0.0, 0.0, 60.0), circle(70.0, -540.0, 24.0), circle(-70.0, -540.0, 24.0)};
    add_pair(flat, outside, outer_cheek, outer_cheek_end, kinematics::paint);
    add_pair(flat, {circle(0.0, 0.0, 68.0)}, outer_cheek_end, 360.0, kinematics::graphite); // motors 4 and 5
    add_pair(flat, {circle(0.0, 0.0, 50.0)}, 360.0, 392.0, kinematics::steel);
    // A shaft for each drive to turn on, held by a foot.
    flat.push_back(hull({circle(second.x(), second.y(), 20.0)}, -lever_far, -60.0, kinematics::steel));
    flat.push_back(hull({circle(third.x(), third.y(), 20.0)}, 60.0, lever_far, kinematics::steel));
    flat.push_back(hull({circle(second.x(), second.y(), 38.0),
                         circle(third.x(), third.y(), 38.0),
                         circle(-60.0, -545.0, 30.0)},
                        -100.0,
                        100.0,
                        kinematics::graphite));
    std::vector<SolidMesh> all;
    for (SolidMesh& mesh : flat) {
        all.push_back(geometry::moved(std::move(mesh), upright()));
    }
    all.push_back(hull({circle(0.0, 0.0, 250.0)}, -613.0, -568.0, kinematics::paint));
    return all;
}

std::vector<SolidMesh> upper_arm(double length, const Linkage& linkage) {
    std::vector<SolidMesh> all;
    const std::initializer_list<Circle> plate = {circle(0.0, 0.0, 92.0), circle(length, 0.0, 74.0)};
    add_pair(all, plate, core_half + 2.0, plate_half, kinematics::paint);
    all.push_back(hull({circle(0.0, 0.0, 76.0), circle(length - 150.0, 0.0, 58.0)},
                       -core_half - 2.0,
                       core_half + 2.0,
                       kinematics::graphite)); // the chains of the wrist run inside
    all.push_back(hull({circle(0.0, 0.0, 40.0)}, -plate_half, lever_far + 6.0, kinematics::steel));
    const Vec2 end = linkage.beta * Vec2(std::cos(linkage.omega), -std::sin(linkage.omega));
    all.push_back(hull({circle(0.0, 0.0, 54.0), {end, 30.0}}, lever_near, lever_far, bronze));
    all.push_back(hull({circle(length, 0.0, 40.0)}, plate_half, plate_half + 14.0, kinematics::steel));
    return all;
}

std::vector<SolidMesh> forearm(double length, const Linkage& linkage) {
    std::vector<SolidMesh> all;
    all.push_back(
        hull({circle(0.0, 0.0, 66.0), circle(length - 90.0, 0.0, 42.0)}, -34.0, 34.0, kinematics::paint));
    add_pair(all,
             {circle(length - 120.0, 0.0, 36.0), circle(length, 0.0, 34.0)},
             24.0,
             40.0,
             kinematics::graphite);
    all.push_back(hull({circle(0.0, 0.0, 34.0)}, -lever_far - 6.0, plate_half, kinematics::steel));
    all.push_back(
        hull({circle(0.0, 0.0, 46.0), circle(-linkage.beta, 0.0, 28.0)}, -lever_far, -lever_near, bronze));
    return all;
}

std::vector<SolidMesh> wrist_meshes() {
    return {hull({circle(0.0, 0.0, 32.0), circle(0.0, -48.0, 30.0)}, -22.0, 22.0, kinematics::paint),
            hull({circle(0.0, 0.0, 17.0)}, -48.0, 48.0, kinematics::steel)};
}

std::vector<SolidMesh> flange() {
    return {hull({circle(0.0, 0.0, 40.0)}, 78.0, 96.0, kinematics::graphite),
            hull({circle(33.0, 0.0, 6.0)}, 80.0, 99.0, bronze)}; // shows how far it has turned
}

std::vector<SolidMesh> gripper() {
    std::vector<SolidMesh> all;
    all.push_back(hull({circle(32.0, 14.0, 8.0),
                        circle(-32.0, 14.0, 8.0),
                        circle(-32.0, -14.0, 8.0),
                        circle(32.0, -14.0, 8.0)},
                       96.0,
                       132.0,
                       grip));
    for (const double side : {-1.0, 1.0}) {
        all.push_back(hull({circle(side * 24.0, 8.0, 6.0), circle(side * 24.0, -8.0, 6.0)},
                           132.0,
                           200.0,
                           kinematics::graphite));
    }
    return all;
}

/// In the frame of a cylinder or rod, whose y is across the arm.
std::vector<SolidMesh> moved_across(std::vector<SolidMesh> meshes, double across) {
    Frame aside = Frame::Identity();
    aside.translation().y() = across;
    for (SolidMesh& mesh : meshes) {
        mesh = geometry::moved(std::move(mesh), aside);
    }
    return meshes;
}

std::vector<SolidMesh> cylinder() {
    return {hull({circle(0.0, 0.0, 26.0)}, -46.0, 286.0, kinematics::graphite),
            hull({circle(0.0, 0.0, 31.0)}, -30.0, 30.0, kinematics::steel),
            hull({circle(0.0, 0.0, 30.0)}, 270.0, 296.0, kinematics::steel)};
}

std::vector<SolidMesh> rod() {
    return {hull({circle(0.0, 0.0, 12.0)}, -500.0, 0.0, kinematics::steel),
            hull({circle(0.0, 0.0, 20.0)}, -40.0, 16.0, kinematics::graphite)};
}

std::vector<SolidMesh> lever(const Linkage& linkage) {
    return {hull({circle(0.0, 0.0, 50.0), circle(-linkage.beta, 0.0, 28.0)}, -lever_far, -lever_near, bronze),
            hull({circle(0.0, 0.0, 34.0)}, -lever_far - 6.0, -plate_half, kinematics::steel),
            hull({circle(-linkage.beta, 0.0, 14.0)}, -lever_far, -coupler_near, kinematics::steel)};
}

std::vector<SolidMesh> coupler(double length) {
    return {hull(
        {circle(0.0, 0.0, 20.0), circle(length, 0.0, 20.0)}, -coupler_far, -coupler_near, kinematics::steel)};
}

} // namespace

MotomanSolids motoman_solids(const ArmModel& arm, const ArmActuators& actuators) {
    if (!arm.planar_elbow() || arm.planar_elbow()->upper_arm < least_link ||
        arm.planar_elbow()->forearm < least_link) {
        throw Error(
            "bodies can only be generated for an arm like the Motoman L-3, with links of 400 mm or more");
    }
    const PlanarElbow& lengths = *arm.planar_elbow();
    MotomanSolids made;
    const auto add = [&](const char* name, ArmCarrier carrier, int number, std::vector<SolidMesh> meshes) {
        made.parts.push_back({name, carrier, number});
        made.bodies.push_back({{name, std::move(meshes)}, Frame::Identity()});
    };
    add("base", ArmCarrier::base, 0, base());
    add("column", ArmCarrier::joint, 0, column(actuators));
    add("upper arm", ArmCarrier::joint, 1, upper_arm(lengths.upper_arm, actuators.second));
    add("forearm", ArmCarrier::joint, 2, forearm(lengths.forearm, actuators.third));
    add("wrist", ArmCarrier::joint, 3, wrist_meshes());
    add("flange", ArmCarrier::joint, 4, flange());
    add("tool", ArmCarrier::joint, 4, gripper());
    add("drive 2 cylinder", ArmCarrier::cylinder, 2, moved_across(cylinder(), drive_middle));
    add("drive 2 rod", ArmCarrier::rod, 2, moved_across(rod(), drive_middle));
    add("drive 3 cylinder", ArmCarrier::cylinder, 3, moved_across(cylinder(), -drive_middle));
    add("drive 3 rod", ArmCarrier::rod, 3, moved_across(rod(), -drive_middle));
    add("drive 3 lever", ArmCarrier::lever, 3, lever(actuators.third));
    add("drive 3 coupler", ArmCarrier::coupler, 3, coupler(lengths.upper_arm));
    JointPositions rest = JointPositions::Zero(arm.joint_count());
    rest[1] = -0.5 * pi;
    rest[2] = 0.5 * pi;
    const std::vector<Frame> places = base_T_parts(arm, actuators, made.parts, rest);
    for (std::size_t n = 0; n < places.size(); ++n) {
        made.bodies[n].at_rest = places[n];
    }
    return made;
}

} // namespace millwright::arm
