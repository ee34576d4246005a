// A plane across what a simulation has left, so that one can look inside. Lengths mm, workpiece coordinates.
#pragma once

#include "core/geometry/vectors.h"
#include "core/simulation/cut_mesh.h"

#include <array>
#include <vector>

namespace millwright::viewport {

/// At `at` along coordinate axis `axis`; what lies above it is taken away, or with `keeps_above` what lies
/// below.
struct StockSection {
    int axis = 1; ///< 0 to 2: X, Y, Z
    double at = 0.0;
    bool keeps_above = true;

    /// How far a point is on the side that is taken away; below 0: on the one that stays.
    [[nodiscard]] double beyond(const Vec3& point) const {
        return keeps_above ? at - point[axis] : point[axis] - at;
    }
    friend bool operator==(const StockSection&, const StockSection&) = default;
};

/// What stays of a mesh, and the material in the plane.
struct SectionedMesh {
    /// A corner: of the mesh where `from` is `to`, else on the edge between two corners of it.
    struct Corner {
        int from = 0, to = 0;
        double share = 0.0; ///< of the way
    };
    std::vector<Corner> corners;
    std::vector<std::array<int, 3>> triangles; ///< indices into corners
    /// Of the plane, counter-clockwise seen from the side that is taken away, three corners each.
    std::vector<std::array<Vec3, 3>> cap;
};

/// The cap is filled in strips of `strip` mm. Throws Defect unless that is above 0.
[[nodiscard]] SectionedMesh
section_of(const simulation::CutMesh& mesh, const StockSection& section, double strip);

} // namespace millwright::viewport
