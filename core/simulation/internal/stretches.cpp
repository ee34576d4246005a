#include "core/simulation/internal/stretches.h"

#include <algorithm>
#include <cmath>

namespace millwright::simulation {

namespace {

using toolpath::ProfileShape;

/// Around a body on a part, relative to its tip.
Box3 box_around(const ProfileShape& shape, const StraightPart& part) {
    Box3 box;
    for (const Vec3& axis : {part.from.axis, part.to.axis}) {
        const Vec3 wide = shape.radius * (Vec3::Ones() - axis.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
        for (const double z : {shape.bottom, shape.top}) {
            box.extend(Vec3(z * axis - wide));
            box.extend(Vec3(z * axis + wide));
        }
    }
    // Between its ends the axis leaves the straight way between them a little.
    constexpr double share = 0.01, least = 0.01;
    const double more =
        least + share * (shape.radius + std::max(std::abs(shape.bottom), std::abs(shape.top)));
    return {Vec3(box.min() - Vec3::Constant(more)), Vec3(box.max() + Vec3::Constant(more))};
}

/// How far the tool can go down before a body above its cutter reaches what the cutter has not cleared from
/// where it was, but for `contact_depth`.
double descent_above(const toolpath::Profile& cutter, const ProfileShape& body) {
    const ProfileShape& shape = cutter.shape();
    const double rho = std::max(std::min(body.radius, shape.radius) - contact_depth, 0.0);
    const double end = std::min(body.bottom, shape.top);
    double outside = shape.bottom, inside = end;
    constexpr int halvings = 40;
    for (int n = 0; n < halvings && outside < inside; ++n) {
        const double middle = 0.5 * (outside + inside);
        (cutter.near({rho, middle}).distance <= 0.0 ? inside : outside) = middle;
    }
    return end - inside;
}

/// How far the tool can go sideways before a body that is within its cutter gets out of what that cleared.
double way_within(const ProfileShape& cutter, const ProfileShape& body) {
    const bool is_within = body.bottom < cutter.top && body.radius <= cutter.radius;
    return is_within ? std::max(cutter.radius - body.radius, contact_depth) : 1e300;
}

} // namespace

geometry::ToolPose StraightPart::at(double f) const {
    if (f <= 0.0 || f >= 1.0) {
        return f <= 0.0 ? from : to;
    }
    return {from.tip + f * (to.tip - from.tip), Vec3(from.axis + f * (to.axis - from.axis)).normalized()};
}

std::optional<PartRange> range_near(const Box3& box, const Box3& around, const Vec3& from, const Vec3& to) {
    PartRange range;
    for (int axis = 0; axis < 3; ++axis) {
        const double way = to[axis] - from[axis];
        const double low = box.min()[axis] - around.max()[axis] - from[axis];
        const double high = box.max()[axis] - around.min()[axis] - from[axis];
        if (std::abs(way) > 0.0) {
            range.first = std::max(range.first, std::min(low / way, high / way));
            range.last = std::min(range.last, std::max(low / way, high / way));
        } else if (low > 0.0 || high < 0.0) {
            return std::nullopt;
        }
    }
    if (!(range.first < range.last) && (to - from).norm() > 0.0) {
        return std::nullopt;
    }
    return range;
}

void AboveCutter::add(const toolpath::Profile& cutter, ToolPart part, const toolpath::Profile& profile) {
    const ProfileShape& shape = profile.shape();
    bodies_.push_back({part, CuttingBody(profile)});
    constexpr double share = 0.5;
    descent_ = std::min(descent_, std::max(share * descent_above(cutter, shape), contact_depth));
    longest_ = std::min(longest_, way_within(cutter.shape(), shape));
    radius_ = std::max(radius_, shape.radius);
}

std::optional<PartRange> AboveCutter::range_near(const Box3& box, const StraightPart& part) const {
    std::optional<PartRange> found;
    for (const Body& one : bodies_) {
        const auto range =
            simulation::range_near(box, box_around(one.body.body.shape(), part), part.from.tip, part.to.tip);
        if (range) {
            found = found
                        ? PartRange{std::min(found->first, range->first), std::max(found->last, range->last)}
                        : *range;
        }
    }
    return found;
}

double AboveCutter::stretch_count(const CuttingBody& cutter, const StraightPart& part) const {
    const Vec3 way = part.to.tip - part.from.tip;
    const double turn = angle_between(part.from.axis, part.to.axis);
    const double turned = turn * radius_;
    const double down = std::max({-way.dot(part.from.axis), -way.dot(part.to.axis), 0.0}) + turned;
    const double aside = (way - way.dot(part.from.axis) * part.from.axis).norm() + turned;
    // On a slope the cutter clears ahead what comes under the body within the same stretch.
    const double descent = aside > contact_depth ? std::min(descent_, steep_stretch) : descent_;
    return std::max({step_count(cutter, part.from, part.to),
                     std::ceil(way.norm() / longest_),
                     std::ceil(down / descent)});
}

} // namespace millwright::simulation
