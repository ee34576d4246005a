// How far a fitted patch and its target are apart, in both directions, and where the patch folds.
#pragma once

#include "core/base/progress.h"
#include "core/exchange/internal/fit_target.h"
#include "core/exchange/internal/triangle_search.h"
#include "core/exchange/patch_fit.h"

#include <optional>
#include <vector>

namespace millwright::exchange {

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
