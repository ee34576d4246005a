#include "core/project/reference_mesh.h"

#include "core/geometry/trimmed_square.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace millwright::project {

namespace {

using exchange::CadFace;
using exchange::TriangleMesh;

constexpr int most_triangles = 300'000; // of all faces together: enough to be recognised
constexpr int most_cells = 24;          // of a patch each way

int cells_of_a_patch(const exchange::CadModel& model) {
    std::size_t patches = 0;
    for (const CadFace& face : model.faces) {
        patches += face.patches.size();
    }
    const double each = 0.5 * most_triangles / static_cast<double>(std::max<std::size_t>(patches, 1));
    return std::clamp(static_cast<int>(std::sqrt(each)), 1, most_cells);
}

/// What lies inside.
void add_patch(TriangleMesh& mesh,
               const geometry::BezierPatch& patch,
               const geometry::Trim& trim,
               int cells) {
    const int base = static_cast<int>(mesh.points.size());
    const geometry::TrimmedSquare square = geometry::trimmed_square(trim, cells, cells);
    for (const Vec2& uv : square.places) {
        mesh.points.push_back(patch.position(uv.x(), uv.y()));
    }
    for (const auto& [a, b, c] : square.inside) {
        mesh.triangles.push_back({base + a, base + b, base + c});
    }
}

void add_faces_but(ReferenceMesh& reference,
                   const exchange::CadModel& model,
                   int chosen,
                   const Progress& progress) {
    TriangleMesh& mesh = reference.rest;
    const int cells = cells_of_a_patch(model);
    for (const CadFace& face : model.faces) {
        progress.check();
        if (face.number == chosen) {
            continue;
        }
        for (int row = 0; row < face.rows; ++row) {
            for (int column = 0; column < face.columns; ++column) {
                if (const auto trim = face.trim_of(row, column)) {
                    const auto patch = static_cast<std::size_t>(row * face.columns + column);
                    add_patch(mesh, face.patches[patch], *trim, cells);
                }
            }
        }
        reference.faces.resize(mesh.triangles.size(), face.number);
    }
}

TriangleMesh scaled(TriangleMesh mesh, double factor) {
    for (Vec3& point : mesh.points) {
        point *= factor;
    }
    return mesh;
}

} // namespace

ReferenceMesh reference_mesh(const ImportSource& source,
                             const ImportChoice& choice,
                             const ImportedSurface* imported,
                             const Progress& progress) {
    ReferenceMesh reference;
    if (imported != nullptr && imported->fit) {
        const exchange::MeshFit& fit = *imported->fit;
        reference.fitted = fit.side;
        reference.deviation = fit.deviation.at_points;
        reference.largest = fit.deviation.max;
        reference.rest = fit.left_out;
    } else if (source.mesh) {
        reference.rest = scaled(source.mesh->mesh, choice.mm_per_unit);
    }
    if (source.model) {
        const bool one_alone = choice.face == 0 && source.model->faces.size() == 1;
        const int chosen = one_alone ? source.model->faces.front().number : choice.face;
        reference.rest = {};
        add_faces_but(reference, *source.model, imported != nullptr ? chosen : 0, progress);
    }
    return reference;
}

} // namespace millwright::project
