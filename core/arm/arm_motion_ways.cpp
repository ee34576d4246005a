#include "core/arm/arm_motion_ways.h"

#include "core/arm/arm_forward.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

namespace millwright::arm {

namespace {

constexpr double radius_tolerance = 0.01; // mm between the radii at both ends of an arc

[[noreturn]] void fail_in_motion(const std::filesystem::path& file, int line, std::string message) {
    throw Error(Diagnostic{.place = {.file = file, .line = line}, .message = std::move(message), .hint = {}});
}

/// A way with its length: the point at u in 0 ... 1, counted from its start.
struct Way {
    double length = 0.0;
    std::function<Vec3(double)> at;
};

/// From the start to the center, for an arc given by its radius in the XY plane.
Vec3 center_by_radius(const ArmBlock& block, const std::filesystem::path& file) {
    const Vec3& way = block.way;
    const double chord = way.head<2>().norm();
    const double radius = std::abs(*block.radius);
    if (!(chord > 0.0) || std::abs(way.z()) > 0.0) {
        fail_in_motion(
            file, block.line, "an arc given by its radius needs a different end point in the XY plane");
    }
    if (radius < 0.5 * chord - radius_tolerance) {
        fail_in_motion(file,
                       block.line,
                       fmt::format("the radius {} is less than half the distance, {:.4f}",
                                   shortest(radius),
                                   0.5 * chord));
    }
    const double height = std::sqrt(std::max(radius * radius - 0.25 * chord * chord, 0.0));
    const Vec3 left(-way.y() / chord, way.x() / chord, 0.0);
    const bool is_left = (block.motion == ArmMotion::counter_clockwise) == (*block.radius > 0.0);
    return 0.5 * way + (is_left ? height : -height) * left;
}

Way arc(const ArmBlock& block, const std::filesystem::path& file) {
    const Vec3 center = block.center ? *block.center : center_by_radius(block, file);
    const Vec3 from = -center, to = block.way - center;
    const double radius = from.norm();
    if (!(radius > 0.0) || std::abs(to.norm() - radius) > radius_tolerance) {
        fail_in_motion(file,
                       block.line,
                       fmt::format("the end is {:.4f} mm from the centre, but the start is {:.4f} mm",
                                   to.norm(),
                                   radius));
    }
    // Counter-clockwise as seen from above; of a plane on edge, from its positive side.
    Vec3 normal = from.cross(to);
    const bool in_line = !(normal.norm() > 1e-9 * radius * radius);
    if (in_line && std::abs(from.z()) > radius_tolerance) {
        fail_in_motion(file,
                       block.line,
                       "start, end and centre lie on a line that leaves the XY plane, so the plane of the "
                       "arc is undefined");
    }
    normal = in_line ? Vec3(Vec3::UnitZ()) : normal.normalized();
    const double above = std::abs(normal.z()) > 1e-9 ? normal.z() : normal.x() + normal.y();
    normal = above < 0.0 ? Vec3(-normal) : normal;
    normal = block.motion == ArmMotion::clockwise ? Vec3(-normal) : normal;
    const double turned = std::atan2(normal.dot(from.cross(to)), from.dot(to));
    constexpr double nothing = 1e-12; // the end at the start: a full circle
    const double angle = turned > nothing ? turned : turned + 2.0 * pi;
    return {radius * angle,
            [=](double u) { return Vec3(center + Eigen::AngleAxisd(u * angle, normal) * from); }};
}

Way way_of(const ArmBlock& block, const std::filesystem::path& file) {
    if (block.motion != ArmMotion::line) {
        return arc(block, file);
    }
    return {block.way.norm(), [way = block.way](double u) { return Vec3(u * way); }};
}

void expect_feed(const ArmBlock& block, const std::filesystem::path& file) {
    if (block.feed && !(*block.feed > 0.0)) {
        fail_in_motion(file, block.line, "the feed F must be above 0");
    }
}

/// The smallest turn that takes the tool axis from `from` to `to`, part of it.
Mat3 turned(const Mat3& tool, const Vec3& to, double share) {
    const Vec3 from = tool.col(2);
    const double angle = angle_between(from, to);
    const Vec3 across = from.cross(to);
    constexpr double straight = 1e-12; // rad
    const Vec3 about = across.norm() > straight ? across.normalized() : Vec3(tool.col(0));
    return Eigen::AngleAxisd(share * angle, about).toRotationMatrix() * tool;
}

} // namespace

void expect_arcs(const std::vector<ArmBlock>& blocks, const std::filesystem::path& file) {
    for (const ArmBlock& block : blocks) {
        (void)way_of(block, file);
        expect_feed(block, file);
    }
}

std::vector<ArmWay> ways_of(const ArmModel& arm,
                            const std::vector<ArmBlock>& blocks,
                            const JointPositions& start,
                            const std::filesystem::path& file) {
    std::vector<ArmWay> ways;
    Frame tool = base_T_tool(arm, start);
    tool.translation() =
        1e-9 * (1e9 * tool.translation()).array().round(); // the home of the thesis is 800 0 650
    double feed = default_arm_feed;
    for (const ArmBlock& block : blocks) {
        const Way way = way_of(block, file);
        const Vec3 axis = block.tool_axis.value_or(Vec3(tool.linear().col(2)));
        feed = block.feed.value_or(feed);
        expect_feed(block, file);
        const auto at = [tool, axis, from = way.at, end = block.way](double share) {
            Frame there = tool;
            there.translation() += share < 1.0 ? from(share) : end;
            there.linear() = turned(tool.linear(), axis, share);
            return there;
        };
        ways.push_back({at, way.length, way.length / feed, block.line});
        tool = at(1.0);
    }
    return ways;
}

bool sets_feed(const std::vector<ArmBlock>& blocks) {
    return std::ranges::any_of(blocks, [](const ArmBlock& block) { return block.feed.has_value(); });
}

} // namespace millwright::arm
