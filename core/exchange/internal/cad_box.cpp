#include "core/exchange/internal/cad_box.h"

#include "core/geometry/surface_bounds.h"

#include <BRepBndLib.hxx>
#include <Bnd_Box.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>

#include <algorithm>
#include <limits>

namespace millwright::exchange {

namespace {

/// Where the whole face, trimmed or not, is farthest along an axis or against it: a place in [0, rows] x [0,
/// columns].
Vec2 farthest_place(const CadFace& face, const Vec3& direction) {
    double farthest = -std::numeric_limits<double>::infinity();
    Vec2 place = Vec2::Zero();
    for (int row = 0; row < face.rows; ++row) {
        for (int column = 0; column < face.columns; ++column) {
            const geometry::BezierPatch& patch =
                face.patches[static_cast<std::size_t>(row * face.columns + column)];
            const Box3& net = patch.control_box();
            if (std::max(net.min().dot(direction), net.max().dot(direction)) <= farthest) {
                continue;
            }
            const geometry::FarthestPoint found = geometry::farthest_point(patch, direction);
            if (found.along > farthest) {
                farthest = found.along;
                place = Vec2(row, column) + found.parameters;
            }
        }
    }
    return place;
}

void extend_by_edges(Box3& box, const TopoDS_Face& shape) {
    for (TopExp_Explorer at(shape, TopAbs_EDGE); at.More(); at.Next()) {
        Bnd_Box edge;
        BRepBndLib::AddOptimal(at.Current(), edge, Standard_False, Standard_False);
        if (edge.IsVoid() || edge.IsOpen()) {
            continue;
        }
        edge.SetGap(0.0);
        const gp_Pnt low = edge.CornerMin();
        const gp_Pnt high = edge.CornerMax();
        box.extend(Vec3(low.X(), low.Y(), low.Z()));
        box.extend(Vec3(high.X(), high.Y(), high.Z()));
    }
}

/// For what is highest inside the outline, but not on the whole face.
void extend_by_raster(Box3& box, const CadFace& face, const geometry::Trim& trim) {
    constexpr int steps = 32;
    for (int i = 1; i < steps; ++i) {
        for (int j = 1; j < steps; ++j) {
            const Vec2 share(static_cast<double>(i) / steps, static_cast<double>(j) / steps);
            if (trim.contains(share)) {
                box.extend(face.position(share.cwiseProduct(Vec2(face.rows, face.columns))));
            }
        }
    }
}

} // namespace

Box3 box_of(const CadFace& face, const TopoDS_Face& shape) {
    const geometry::Trim trim = face.trim();
    Box3 box;
    for (int axis = 0; axis < 3; ++axis) {
        for (const double sign : {-1.0, 1.0}) {
            const Vec2 place = farthest_place(face, sign * Vec3::Unit(axis));
            if (trim.everything() || trim.contains(place.cwiseQuotient(Vec2(face.rows, face.columns)))) {
                box.extend(face.position(place));
            }
        }
    }
    if (!trim.everything()) {
        extend_by_edges(box, shape);
        extend_by_raster(box, face, trim);
    }
    return box;
}

} // namespace millwright::exchange
