// How far a point of what is left lies over the machined face, for a picture: the closest point of the face,
// and the distance along its normal. Figures come from core/simulation/comparison.h. Lengths mm.
#pragma once

#include "core/geometry/closest_point.h"
#include "core/plan/evaluation.h"
#include "core/simulation/cut_mesh.h"

#include <optional>
#include <vector>

namespace millwright::plan {

class PartHeights {
public:
    explicit PartHeights(const CuttingSetup& cutting_setup);

    /// Above 0 on the side of the tool; nothing for a point beside the face, which has no place of it below
    /// or above.
    [[nodiscard]] std::optional<double> at(const Vec3& point) const;

    /// Of the points of a mesh. Nothing too for what lies below the face and was never cut: the underside of
    /// a stock is no gouge. Throws Cancelled.
    [[nodiscard]] std::vector<std::optional<double>> of(const simulation::CutMesh& mesh,
                                                        const Progress& progress) const;

private:
    CuttingSetup cutting_setup_;
    geometry::ClosestPointSearch search_;
};

} // namespace millwright::plan
