#include "ui/viewport/arm_grip.h"

#include "core/arm/arm_forward.h"
#include "ui/render/convert.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace millwright::viewport {

namespace {

using arm::ArmCarrier;
using arm::ArmPart;
using arm::JointPositions;

/// The joint that a person means who takes hold of a part; -1 of what does not move.
int joint_of(const ArmPart& part) {
    switch (part.carrier) {
    case ArmCarrier::base:
        return -1;
    case ArmCarrier::joint:
        return part.number;
    case ArmCarrier::cylinder:
    case ArmCarrier::rod:
        return part.number - 1; // drive 2 turns joint 2
    case ArmCarrier::lever:
    case ArmCarrier::coupler:
        return 2;
    }
    return -1;
}

/// How far along the ray it meets a triangle (Moeller and Trumbore 1997); infinite if it does not.
double distance_to(const Vec3& origin, const Vec3& direction, const Vec3& a, const Vec3& b, const Vec3& c) {
    constexpr double parallel = 1e-12;
    constexpr double never = std::numeric_limits<double>::infinity();
    const Vec3 ab = b - a, ac = c - a;
    const Vec3 across = direction.cross(ac);
    const double volume = ab.dot(across);
    if (!(std::abs(volume) > parallel)) {
        return never;
    }
    const Vec3 from = origin - a;
    const double u = from.dot(across) / volume;
    const Vec3 turned = from.cross(ab);
    const double v = direction.dot(turned) / volume;
    if (!(u >= 0.0 && v >= 0.0 && u + v <= 1.0)) {
        return never;
    }
    const double t = ac.dot(turned) / volume;
    return t > 0.0 ? t : never;
}

double distance_to(const geometry::SolidBody& body, const Vec3& origin, const Vec3& direction) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const geometry::SolidMesh& mesh : body.meshes) {
        const auto at = [&](int n) { return mesh.positions[static_cast<std::size_t>(n)]; };
        for (const auto& [a, b, c] : mesh.triangles) {
            nearest = std::min(nearest, distance_to(origin, direction, at(a), at(b), at(c)));
        }
    }
    return nearest;
}

Vec3 point_of_link(
    const ArmScene& scene, JointPositions joints, int joint, double position, const Vec3& local) {
    joints[joint] = position;
    return arm::base_T_joints(scene.look->arm(), joints)[static_cast<std::size_t>(joint)] * local;
}

std::optional<glm::dvec2> projected_pixel(const render::View& view, const Vec3& point) {
    const auto seen = render::project(view, render::to_glm(point));
    return seen ? std::optional(seen->pixel) : std::nullopt;
}

} // namespace

std::optional<ArmGrip>
pick_arm(const ArmScene& scene, const render::View& view, const glm::dvec2& pixel, double within_px) {
    const arm::ArmModel& arm = scene.look->arm();
    const Vec3 tip = arm::base_T_tool(arm, scene.joints).translation();
    if (const auto seen = projected_pixel(view, tip); seen && glm::length(*seen - pixel) <= within_px) {
        return ArmGrip{ArmGrip::tip, tip};
    }
    if (scene.part) {
        const Vec3 zero = scene.part->translation();
        if (const auto seen = projected_pixel(view, zero); seen && glm::length(*seen - pixel) <= within_px) {
            return ArmGrip{ArmGrip::part, zero};
        }
    }
    if (!scene.look->file.bodies) {
        return std::nullopt;
    }
    const render::Ray sight = render::ray(view, pixel);
    const Vec3 origin = render::to_core(sight.origin), direction = render::to_core(sight.direction);
    const auto& parts = scene.look->file.bodies->parts;
    const std::vector<Frame> places = arm::base_T_parts(arm, scene.look->file.actuators, parts, scene.joints);
    double nearest = std::numeric_limits<double>::infinity();
    int joint = -1;
    for (std::size_t n = 0; n < parts.size(); ++n) {
        const Frame inverse = places[n].inverse();
        const double distance =
            distance_to(scene.look->bodies[n], inverse * origin, inverse.linear() * direction);
        if (distance < nearest) {
            nearest = distance;
            joint = joint_of(parts[n]);
        }
    }
    return joint < 0 ? std::nullopt : std::optional(ArmGrip{joint, Vec3(origin + nearest * direction)});
}

/// Gauss and Newton: along the way of the point in the picture, by small turns.
double joint_towards(
    const ArmScene& scene, int joint, const Vec3& local, const render::View& view, const glm::dvec2& pixel) {
    constexpr int rounds = 24;
    constexpr double small = 1e-5;  // rad or mm, for the difference
    constexpr double slow_px = 1.0; // a point that moves less a radian goes along the line of sight
    const arm::ArmJoint& limits = scene.look->arm().joint(joint);
    const bool turns = limits.kind == arm::JointKind::revolute;
    const double largest = turns ? 0.2 : 50.0;
    double position = scene.joints[joint];
    for (int n = 0; n < rounds; ++n) {
        const auto here = projected_pixel(view, point_of_link(scene, scene.joints, joint, position, local));
        const auto beside =
            projected_pixel(view, point_of_link(scene, scene.joints, joint, position + small, local));
        if (!here || !beside) {
            break;
        }
        const glm::dvec2 way = (*beside - *here) / small;
        const double squared = glm::dot(way, way);
        if (!(squared > slow_px * slow_px)) {
            break;
        }
        const double step = glm::dot(pixel - *here, way) / squared;
        position += std::clamp(step, -largest, largest);
        if (std::abs(step) < small) {
            break;
        }
    }
    return std::clamp(position, limits.min, limits.max);
}

} // namespace millwright::viewport
