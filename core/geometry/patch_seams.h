// Where patches share a side, and how well they meet there.
#pragma once

#include "core/geometry/bezier_patch.h"

#include <string_view>
#include <vector>

namespace millwright::geometry {

enum class Side { u_start, u_end, v_start, v_end };

/// "u = 0", "v = 1".
[[nodiscard]] std::string_view to_text(Side side);

/// A side of one of several patches.
struct PatchSide {
    int patch = 0;
    Side side = Side::u_start;

    friend bool operator==(const PatchSide&, const PatchSide&) = default;
};

/// Two sides that belong together.
struct Seam {
    PatchSide a, b;
    bool reversed = false; ///< b runs the other way along its parameter
};

/// The pairs of sides whose ends lie within `tolerance` (mm) of each other, nearest first; a side is in one
/// seam at most, and no seam joins a patch to itself.
[[nodiscard]] std::vector<Seam> seams_of(const std::vector<BezierPatch>& patches, double tolerance);

/// The pairs of sides that face each other across a gap and are in none of `joined`, nearest first; a side is
/// in one of them at most. The ends are no further apart than a quarter of what the two patches measure along
/// the sides and across them, so that nothing but the gap has room between them, and the two patches do not
/// go the same way from there (60 degrees or less), as the ends of a bent strip beside each other do.
[[nodiscard]] std::vector<Seam> open_seams_of(const std::vector<BezierPatch>& patches,
                                              const std::vector<Seam>& joined);

/// How well two patches meet, at 65 places of the seam. mm, rad.
struct SeamFigures {
    double gap = 0.0;   ///< largest distance of the two sides at the same parameter
    double angle = 0.0; ///< largest angle between their normals
};
[[nodiscard]] SeamFigures figures_of(const std::vector<BezierPatch>& patches, const Seam& seam);

} // namespace millwright::geometry
