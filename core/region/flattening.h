// A sheet of triangles spread out flat, and how much that distorts it. Sources: Levy et al., Least Squares
// Conformal Maps, 2002; Pinkall and Polthier 1993 (cotangent weights); Floater, Mean Value Coordinates, 2003;
// Tutte 1963 (nothing folds with positive weights over a convex outline).
#pragma once

#include "core/base/progress.h"
#include "core/region/face_mesh.h"

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace millwright::region {

enum class FlatteningMethod {
    own_parameters, ///< a raster of faces that continue one another: their parameters side by side
    harmonic,       ///< onto the square, the boundary by its length between four corners
    mean_value,     ///< the same by weights that are never negative
    conformal,      ///< angles kept, the boundary as it comes
};
[[nodiscard]] std::string_view name_of(FlatteningMethod method);

/// Points of the boundary by their places in it, counter-clockwise: those at (0,0), (1,0), (1,1) and (0,1).
using SheetCorners = std::array<int, 4>;

struct Flattening {
    FlatteningMethod method = FlatteningMethod::harmonic;
    std::vector<Vec2> places; ///< per point of the mesh: in [0,1]^2; of a conformal one mm
    SheetCorners corners{};   ///< of those onto the square
    /// Mean of (a^2 + b^2 + 1/a^2 + 1/b^2) / 4 over the area, a and b being the stretches of a triangle's map
    /// against even ones (symmetric Dirichlet energy); 1 is without any, infinite where something folds.
    double distortion = 1.0;
    /// How often a triangle's area at most is larger or smaller in the flat, against all of them; 95 % of the
    /// area is below.
    double area_ratio = 1.0;
    std::vector<Vec3> folds; ///< middles of triangles that are upside down or without area, mm

    [[nodiscard]] bool injective() const { return folds.empty(); }
};

/// The lengths of the sides of a rectangle that the square best stands for, mm: those of the mean stretches.
[[nodiscard]] Vec2 extent_of(const FaceMesh& mesh, const std::vector<Vec2>& places);

/// Four points of the boundary with the least distortion of a harmonic map that the search finds.
[[nodiscard]] SheetCorners proposed_corners(const FaceMesh& mesh, const Progress& progress);

/// The points of the boundary next to those places, mm, in any order; (0,0) is the first of them. Throws
/// Error if two are the same point of the boundary.
[[nodiscard]] SheetCorners corners_near(const FaceMesh& mesh, const std::array<Vec3, 4>& places);

/// Throws Error where the sheet is so degenerate that the equations have no solution.
[[nodiscard]] Flattening harmonic(const FaceMesh& mesh, const SheetCorners& corners);
[[nodiscard]] Flattening mean_value(const FaceMesh& mesh, const SheetCorners& corners);
[[nodiscard]] Flattening conformal(const FaceMesh& mesh);
/// Nothing unless the faces are a raster of whole sides and each continues the next with the same direction
/// and, by one width for each row and column, the same speed.
[[nodiscard]] std::optional<Flattening> own_parameters(std::span<const ExactFace> faces,
                                                       const FaceMesh& mesh);

/// Onto the square: by own parameters where that is possible and no corners are given, so that a surface
/// divided into faces is what it was; else harmonic, which depends on the surface and hardly on the mesh; by
/// mean values, which depend on the mesh, where that folds. Throws Error with the place where both fold;
/// Cancelled.
[[nodiscard]] Flattening flattened(std::span<const ExactFace> faces,
                                   const FaceMesh& mesh,
                                   const std::optional<SheetCorners>& corners,
                                   const Progress& progress);

} // namespace millwright::region
