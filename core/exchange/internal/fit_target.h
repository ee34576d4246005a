// What a patch is fitted to: triangles, or the part of a face that they approximate; and points spread over
// it.
#pragma once

#include "core/exchange/cad_file.h"
#include "core/exchange/internal/mesh_outlines.h"
#include "core/exchange/internal/visible_side.h"

#include <array>
#include <vector>

namespace millwright::exchange {

/// A mix of three points of the mesh.
struct Spread {
    std::array<int, 3> corners{};
    Vec3 shares = Vec3::Zero(); ///< of the corners; their sum is 1

    template <typename Value> [[nodiscard]] Value of(const std::vector<Value>& values) const {
        Value sum = Value::Zero();
        for (std::size_t k = 0; k < 3; ++k) {
            sum += shares[static_cast<Eigen::Index>(k)] * values[static_cast<std::size_t>(corners[k])];
        }
        return sum;
    }
};

struct FitTarget {
    VisibleSide side;
    const CadFace* face = nullptr; ///< null for a mesh
    std::vector<Vec2> places;      ///< on the face, one per point of the side; empty for a mesh
    MeshOutlines outlines{};       ///< of a mesh alone

    [[nodiscard]] Vec3 at(const Spread& spread) const {
        return face != nullptr ? face->position(spread.of(places)) : spread.of(side.mesh.points);
    }
};

/// `count` points, equally many on equal areas: by steps of equal area along the triangles, inside each by
/// the sequence R2 (Roberts 2018), which leaves no gaps. The same points for the same mesh. `area`: of the
/// mesh, mm^2.
[[nodiscard]] std::vector<Spread> spread_over(const TriangleMesh& mesh, double area, int count);

} // namespace millwright::exchange
