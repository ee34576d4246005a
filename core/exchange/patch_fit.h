// A Bezier patch of chosen degree near a mesh or a face: least squares over points spread evenly on the
// triangles. After each round their parameters go to the nearest point of the patch (Hoschek and Lasser,
// Fundamentals of Computer Aided Geometric Design, ch. 4.4), and the next one counts the distance from the
// tangent plane there, which lets points slide along the patch and needs few rounds (Blake and Isard 1998,
// "tangent distance minimization").
#pragma once

#include "core/base/progress.h"
#include "core/exchange/cad_file.h"
#include "core/exchange/triangle_mesh.h"
#include "core/geometry/bezier_patch.h"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

namespace millwright::exchange {

/// Above it the basis is too badly conditioned for least squares.
inline constexpr int max_fit_degree = 12;

/// Values outside their range throw Defect.
struct FitSettings {
    int degree_u = 5; ///< 1 to `max_fit_degree`
    int degree_v = 5; ///< the same
    std::optional<Vec3> along =
        std::nullopt;   ///< unit, out of the part: the side that is fitted; else found, or a whole face
    int points = 5'000; ///< spread over the triangles, at least 100
    int rounds = 12;    ///< of correcting the parameters, at most
};

/// Distances between the patch and its mesh or face, in both directions, mm.
struct Deviation {
    // Points of the mesh from the patch. For a face: points spread densely inside its outline.
    std::vector<double> at_points; ///< one per point of `MeshFit::side`; positive on the side of the normal
    double max = 0.0;              ///< without sign
    double mean = 0.0;             ///< without sign
    double rms = 0.0;
    // Points of the patch, inside its trim, from the mesh or the face.
    double patch_max = 0.0;
    double patch_mean = 0.0;          ///< over the area
    Vec2 patch_max_at = Vec2::Zero(); ///< (u, v)

    /// The Hausdorff distance, as far as the points show it.
    [[nodiscard]] double largest() const { return std::max(max, patch_max); }
};

/// From each point to the patch; nothing of the other direction. Throws Cancelled.
[[nodiscard]] Deviation deviation_of_points(const std::vector<Vec3>& points,
                                            const geometry::BezierPatch& patch,
                                            const Progress& progress);

struct MeshFit {
    geometry::BezierPatch patch;
    geometry::Trim trim;        ///< the outline of a trimmed face on the patch
    TriangleMesh side;          ///< the part of the mesh that was fitted
    TriangleMesh left_out;      ///< the triangles that look the other way or sideways
    double left_out_area = 0.0; ///< mm^2
    Vec3 along = Vec3::UnitZ(); ///< unit, the way from which the side was seen
    bool follows_outline = false;
    int outline_corners = 0;   ///< of the side, as seen; a patch that follows the outline has four
    std::vector<double> holes; ///< of the side, that the patch goes across: largest width, mm, largest first
    Deviation deviation;
    int rounds = 0;
};

/// The side of the mesh that is seen from `along` (if not given its mean normal, or +z where the mesh is
/// closed). Where that is one sheet with four corners and no hole the patch follows its outline; else it
/// fills the least rectangle around it, and goes on with little bending where that is empty. Throws Error if
/// no triangle looks that way or they all lie in a line, and if the patch folds or leaves the mesh;
/// Cancelled.
[[nodiscard]] MeshFit
fit_patch(const TriangleMesh& mesh, const FitSettings& settings, const Progress& progress);

/// The same near a face: the points that are fitted and measured lie on the face itself, between the corners
/// of the triangles, too. The whole face keeps its parameters, so that the patch follows its sides; with
/// `FitSettings::along` only what is seen from there is fitted, as of a mesh.
[[nodiscard]] MeshFit fit_face(const CadFace& face, FitSettings settings, const Progress& progress);

} // namespace millwright::exchange
