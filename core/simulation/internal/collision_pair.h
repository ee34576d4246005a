// Two bodies that may not meet. The moving one is a body of revolution or a mesh, the still one a mesh.
// Lengths mm, frame m with all axes at their physical zero.
#pragma once

#include "core/simulation/collision_bodies.h"
#include "core/simulation/collision_motion.h"
#include "core/simulation/collision_search.h"
#include "core/toolpath/profile.h"

#include <memory>
#include <optional>
#include <string>

namespace millwright::simulation {

/// A part of the tool in the spindle.
struct TurnedBody {
    std::string name;
    toolpath::Profile profile;
    geometry::ToolPose pose;                         ///< in m
    std::shared_ptr<const CollisionMesh> mesh;       ///< the same with sides, for how deep it is in others
    std::shared_ptr<const CollisionMesh> rough_mesh; ///< with few sides
};

class CollisionPair {
public:
    /// Nearer than -`allowance` they meet. `warned`: near misses count.
    CollisionPair(std::shared_ptr<const TurnedBody> moving,
                  char carrier,
                  const CollisionBody& still,
                  double allowance,
                  bool warned);
    CollisionPair(const CollisionBody& moving, const CollisionBody& still);

    [[nodiscard]] const std::string& moving_name() const { return moving_name_; }
    [[nodiscard]] const std::string& still_name() const { return still_.name; }
    [[nodiscard]] char moving_carrier() const { return carrier_; }
    [[nodiscard]] char still_carrier() const { return still_.carrier; }
    /// Whether both pairs have the same relative motion.
    [[nodiscard]] bool moves_as(const CollisionPair& other) const {
        return carrier_ == other.carrier_ && still_.carrier == other.still_.carrier;
    }
    /// Whether one of both is the stock.
    [[nodiscard]] bool has_stock() const {
        return still_.role == BodyRole::stock || moving_role_ == BodyRole::stock;
    }
    /// The same with this surface of the stock.
    [[nodiscard]] CollisionPair with_stock(const std::shared_ptr<const CollisionMesh>& surface) const;
    /// Around the moving body.
    [[nodiscard]] const BodyBall& ball() const { return ball_; }

    [[nodiscard]] std::optional<Approach> approach(const RelativeMotion& motion, double clearance) const;

    /// Whether the moving body's middle lies in the still one at the beginning, or a corner of the still one
    /// in the moving one: they then need not cross.
    [[nodiscard]] bool is_inside(const RelativeMotion& motion) const;

    enum class Care { rough, close };
    /// How deep they are in each other: the deepest point of one surface in the other body, measured to its
    /// nearest surface. Of meshes the deepest that was found. Below 0: apart, at least so far.
    [[nodiscard]] double depth(const Frame& still_T_moving, Care care) const;

    [[nodiscard]] bool are_within(const Frame& still_T_moving, double distance) const;

private:
    [[nodiscard]] geometry::ToolPose pose_at(const Frame& still_T_moving) const;
    [[nodiscard]] std::optional<NearPlace>
    nearest(const Frame& still_T_moving, double below, double settled) const;
    [[nodiscard]] const CollisionMesh& moving_mesh(Care care) const {
        return !turned_ ? *moving_mesh_ : care == Care::rough ? *turned_->rough_mesh : *turned_->mesh;
    }

    std::shared_ptr<const TurnedBody> turned_; ///< null: a mesh
    std::shared_ptr<const CollisionMesh> moving_mesh_;
    bool moving_closed_ = true;
    BodyRole moving_role_ = BodyRole::machine;
    std::string moving_name_;
    char carrier_ = '\0';
    CollisionBody still_;
    BodyBall ball_;
    double contact_ = 0.0; // the distance at which they meet
    bool warned_ = true;
};

} // namespace millwright::simulation
