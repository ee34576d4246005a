#include "core/simulation/internal/collision_pair.h"

#include "core/simulation/collision.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::simulation {

namespace {

BodyBall ball_around(const CollisionMesh& mesh) {
    const Vec3 center = mesh.box().center();
    double square = 0.0;
    for (const Vec3& point : mesh.surface().points) {
        square = std::max(square, (point - center).squaredNorm());
    }
    return {center, std::sqrt(square)};
}

BodyBall ball_around(const TurnedBody& body) {
    const toolpath::ProfileShape& shape = body.profile.shape();
    const Vec3 center = body.pose.tip + 0.5 * (shape.bottom + shape.top) * body.pose.axis;
    return {center, std::hypot(shape.radius, 0.5 * (shape.top - shape.bottom)), body.pose.axis};
}

/// Meshes whose distance is less have met: FCL's numbers are rounded.
constexpr double mesh_contact = 1e-7; // mm

} // namespace

CollisionPair::CollisionPair(std::shared_ptr<const TurnedBody> moving,
                             char carrier,
                             const CollisionBody& still,
                             double allowance,
                             bool warned)
    : turned_(std::move(moving)), moving_name_(turned_->name), carrier_(carrier), still_(still),
      ball_(ball_around(*turned_)), contact_(-allowance), warned_(warned) {}

CollisionPair::CollisionPair(const CollisionBody& moving, const CollisionBody& still)
    : moving_mesh_(moving.mesh), moving_closed_(moving.closed), moving_role_(moving.role),
      moving_name_(moving.name), carrier_(moving.carrier), still_(still), ball_(ball_around(*moving.mesh)),
      contact_(mesh_contact) {}

CollisionPair CollisionPair::with_stock(const std::shared_ptr<const CollisionMesh>& surface) const {
    CollisionPair pair = *this;
    if (still_.role == BodyRole::stock) {
        pair.still_.mesh = surface;
    } else {
        pair.moving_mesh_ = surface;
        pair.ball_ = ball_around(*surface);
    }
    return pair;
}

geometry::ToolPose CollisionPair::pose_at(const Frame& still_T_moving) const {
    return {still_T_moving * turned_->pose.tip, still_T_moving.linear() * turned_->pose.axis};
}

std::optional<NearPlace>
CollisionPair::nearest(const Frame& still_T_moving, double below, double settled) const {
    if (turned_) {
        return still_.mesh->nearest(
            turned_->profile, pose_at(still_T_moving), {.below = below, .settled = settled});
    }
    const Vec3 center = still_T_moving * ball_.center;
    if (still_.mesh->box().exteriorDistance(center) - ball_.radius >= below) {
        return std::nullopt;
    }
    return still_.mesh->nearest(*moving_mesh_, still_T_moving, below);
}

std::optional<Approach> CollisionPair::approach(const RelativeMotion& motion, double clearance) const {
    BodyWay way;
    way.nearest = [&](double t, double below) { return nearest(motion.at(t), below, contact_); };
    way.reach = [&](double t, double half) { return motion.reach(t, half, ball_); };
    way.parts = motion.parts();
    way.contact = contact_;
    way.clearance = warned_ ? std::max(clearance, contact_) : contact_;
    return simulation::approach(way);
}

bool CollisionPair::is_inside(const RelativeMotion& motion) const {
    const Frame pose = motion.at(0.0);
    if (still_.closed && still_.mesh->box().contains(pose * ball_.center) &&
        still_.mesh->signed_distance(pose * ball_.center) < 0.0) {
        return true;
    }
    if (turned_ || !moving_closed_) {
        return false; // triangles in a body of revolution are found as they are
    }
    const Vec3 corner = pose.inverse() * still_.mesh->surface().points.front();
    return moving_mesh_->box().contains(corner) && moving_mesh_->signed_distance(corner) < 0.0;
}

double CollisionPair::depth(const Frame& still_T_moving, Care care) const {
    const bool rough = care == Care::rough;
    const int looks = rough ? 50 : 4000;
    double depth = -1.0;
    if (turned_) {
        constexpr double far = 1e300;
        const double tolerance = rough ? 0.02 : 0.002; // mm
        const auto near = still_.mesh->nearest(
            turned_->profile, pose_at(still_T_moving), {.below = far, .tolerance = tolerance});
        depth = near ? -near->distance : depth;
    } else if (moving_closed_) {
        if (const auto found = moving_mesh_->deepest(*still_.mesh, still_T_moving.inverse(), looks)) {
            depth = std::max(depth, found->distance);
        }
    }
    if (still_.closed) {
        if (const auto found = still_.mesh->deepest(moving_mesh(care), still_T_moving, looks)) {
            depth = std::max(depth, found->distance);
        }
    }
    return depth;
}

bool CollisionPair::are_within(const Frame& still_T_moving, double distance) const {
    return nearest(still_T_moving, distance, distance).has_value();
}

} // namespace millwright::simulation
