// How far a fitted patch and its target are apart, in both directions, and where the patch folds.
#pragma once

#include "core/base/progress.h"
#include "core/exchange/cad_file.h"
#include "core/exchange/internal/triangle_search.h"
#include "core/exchange/internal/visible_side.h"
#include "core/exchange/patch_fit.h"

#include <array>
#include <optional>
#include <vector>

namespace millwright::exchange {

// What a patch is fitted to: triangles, or the part of a face that they approximate; and points spread over
// it.

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

/// The part of a patch that faces backwards.
struct Fold {
    double share = 0.0;     ///< of the patch's area, 0 to 1
    Vec2 at = Vec2::Zero(); ///< (u, v) of its largest sample
};

/// Compares patches with the target that they are fitted to. Refers to `target`.
class FitComparison {
public:
    /// `along`: the unit direction from which the side is seen; nullopt for a whole face.
    FitComparison(const FitTarget& target, const std::optional<Vec3>& along);

    /// At 129 x 129 points of the whole patch. Throws Cancelled.
    [[nodiscard]] Fold fold_of(const geometry::BezierPatch& patch, const Progress& progress) const;

    /// From the target to the patch: at each point of a mesh; on a face at `points` points, equally many on
    /// equal areas, and at the corners of its triangles, both only inside its outline. From the patch to the
    /// target: at 129 x 129 points over the box of `trim`, where they lie inside it, and at its corners.
    /// Throws Error for a patch that folds inside `trim` or leaves its target; Cancelled.
    [[nodiscard]] Deviation deviation_of(const geometry::BezierPatch& patch,
                                         const geometry::Trim& trim,
                                         bool follows_outline,
                                         int points,
                                         const Progress& progress) const;

private:
    /// A point of the patch against the nearest point of the target.
    struct PatchPoint {
        double distance = 0.0; ///< mm
        double area = 0.0;     ///< |S_u x S_v|, mm^2
        bool reversed = false; ///< the patch faces backwards there
    };

    [[nodiscard]] PatchPoint compared(const geometry::BezierPatch& patch, const Vec2& uv, bool exactly) const;
    [[nodiscard]] bool faces_away(const Vec3& normal, const Vec2& uv) const;
    void measure_patch(Deviation& deviation,
                       const geometry::BezierPatch& patch,
                       const geometry::Trim& trim,
                       const Progress& progress) const;

    const FitTarget* target_;
    std::optional<Vec3> along_;
    TriangleSearch triangles_;
};

} // namespace millwright::exchange
