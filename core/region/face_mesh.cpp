#include "core/region/face_mesh.h"

#include "core/base/error.h"
#include "core/region/internal/face_triangles.h"
#include "core/region/internal/sheet_checks.h"
#include "core/region/internal/side_welding.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace millwright::region {

namespace {

/// By the middles of 16 x 16 cells, mm^2.
double area(const geometry::BsplineSurface& face) {
    constexpr int cells = 16;
    double sum = 0.0;
    for (int i = 0; i < cells; ++i) {
        for (int j = 0; j < cells; ++j) {
            const geometry::SurfaceDerivatives at = face.derivatives((i + 0.5) / cells, (j + 0.5) / cells);
            sum += at.du.cross(at.dv).norm();
        }
    }
    return sum / (cells * cells);
}

void check(std::span<const ExactFace> faces, const FaceMeshSettings& settings) {
    expects(settings.tolerance > 0.0 && settings.triangles > 0, "faces are welded within a tolerance");
    if (faces.empty()) {
        throw Error("no face is chosen");
    }
    if (std::ssize(faces) > most_region_faces) {
        throw Error(fmt::format(
            "{} faces are too many for one region: the maximum is {}", faces.size(), most_region_faces));
    }
}

/// Two triangles on each square of this length, mm.
double spacing(std::span<const ExactFace> faces, int triangles) {
    double whole = 0.0;
    for (const ExactFace& face : faces) {
        whole += area(face.surface);
    }
    const double side = std::sqrt(2.0 * whole / triangles);
    if (!std::isfinite(side) || !(side > 0.0)) {
        throw Error("the chosen faces have no area");
    }
    return side;
}

} // namespace

FaceMesh
face_mesh(std::span<const ExactFace> faces, const FaceMeshSettings& settings, const Progress& progress) {
    check(faces, settings);
    const double apart = spacing(faces, settings.triangles);
    WeldedSides welded = weld_sides(faces, settings.tolerance, apart, progress.part(0.0, 0.3));
    FaceMesh mesh;
    mesh.points = welded.points;
    for (int face = 0; face < std::ssize(faces); ++face) {
        progress.check();
        add_triangles(face, faces[static_cast<std::size_t>(face)], welded, apart, mesh);
    }
    mesh.borders = std::move(welded.borders);
    mesh.turned_over = turned_faces(faces, mesh);
    for (FaceTriangle& triangle : mesh.triangles) {
        if (mesh.turned_over[static_cast<std::size_t>(triangle.face)]) {
            std::swap(triangle.corners[1], triangle.corners[2]);
            std::swap(triangle.parameters[1], triangle.parameters[2]);
        }
    }
    progress.report(0.4);
    refuse_overlaps(faces, mesh, settings.tolerance, progress.part(0.4, 1.0));
    mesh.boundary = boundary_of(mesh);
    progress.report(1.0);
    return mesh;
}

} // namespace millwright::region
