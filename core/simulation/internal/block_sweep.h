// The motion of one block's tool, seen from points of the part. Lengths mm.
#pragma once

#include "core/kinematics/forward.h"
#include "core/simulation/simulation.h"

namespace millwright::simulation {

class BlockSweep {
public:
    /// `body` must outlive it.
    BlockSweep(const SimulationInput& input, int block, const ToolUse& tool);

    /// The least height of the tool over `at` along the unit `normal`; infinite where it does not come over
    /// it.
    [[nodiscard]] double height(const Vec3& at, const Vec3& normal) const;
    /// How deep the point is in the tool, whatever the direction; below 0 or infinitely so: outside.
    [[nodiscard]] double depth(const Vec3& at, const Vec3& normal) const;

    /// height() at the middle of the move; infinite where the tool never contains the point, and below all
    /// where the move is too long for one look.
    [[nodiscard]] double glance(const Vec3& at, const Vec3& normal) const;

private:
    struct Look;
    template <class Value> [[nodiscard]] double least(const Look& look, const Value& value) const;
    template <class Value>
    void divide(double from,
                double to,
                const geometry::ToolPose& first,
                const geometry::ToolPose& last,
                Look& look,
                const Value& value) const;
    [[nodiscard]] bool misses(const geometry::ToolPose& pose, double motion, const Look& look) const;

    const toolpath::Profile* body_;
    kinematics::StraightForward way_;
    kinematics::Bend bend_;
    double reach_ = 0.0; ///< no point of the body is farther from the tip
};

} // namespace millwright::simulation
