// One sheet of triangles over several faces of a CAD model, welded along the borders they share. Every corner
// of a triangle keeps the face that it lies on and its parameters there, so that nothing is lost by the mesh.
#pragma once

#include "core/base/progress.h"
#include "core/geometry/bspline_surface.h"
#include "core/geometry/vectors.h"

#include <array>
#include <span>
#include <vector>

namespace millwright::region {

/// A face with all its four sides; what an outline cuts off is no part of this.
struct ExactFace {
    geometry::BsplineSurface surface;
    int number = 1; ///< what messages call it
};

/// A place on a side of a face: 0: v = 0, 1: u = 1, 2: v = 1, 3: u = 0, run through counter-clockwise.
/// `along` in [0,1].
[[nodiscard]] Vec2 place_on_side(int side, double along);

/// A piece of the border of one face, or the same piece of two.
struct FaceBorder {
    /// Where the points lie on the side of a face: in [0,1], rising or falling.
    struct Side {
        int face = 0; ///< from 0
        int side = 0; ///< as of `place_on_side`
        std::vector<double> along;

        [[nodiscard]] bool rises() const { return along.front() < along.back(); }
    };
    std::vector<int> points; ///< of the mesh, one after the other, both ends among them
    std::vector<Side> sides; ///< one, or two where faces meet
};

struct FaceTriangle {
    int face = 0;                        ///< from 0
    std::array<int, 3> corners{};        ///< points of the mesh
    std::array<Vec2, 3> parameters = {}; ///< of the face, at each corner
};

/// A disc: connected, with one boundary, no hole and no place where more than two triangles meet.
struct FaceMesh {
    std::vector<Vec3> points; ///< mm
    /// Counter-clockwise seen from the side that S_u x S_v of the first face looks to.
    std::vector<FaceTriangle> triangles;
    std::vector<FaceBorder> borders;
    std::vector<int> boundary;     ///< points, counter-clockwise, not closed
    std::vector<bool> turned_over; ///< per face: its S_u x S_v looks to the other side
};

struct FaceMeshSettings {
    double tolerance = 0.01; ///< mm, by which borders that are the same may be apart
    int triangles = 8000;    ///< about so many
};

inline constexpr int most_region_faces = 200;

/// Throws Error that names faces and place: a side that is shared in part or by more than two faces, faces
/// that do not touch, overlap, fold back on one another or cannot be turned to one side, a hole, a closed
/// shell, too many faces; Cancelled.
[[nodiscard]] FaceMesh
face_mesh(std::span<const ExactFace> faces, const FaceMeshSettings& settings, const Progress& progress);

} // namespace millwright::region
