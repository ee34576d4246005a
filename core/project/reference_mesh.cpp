#include "core/project/reference_mesh.h"

#include "core/geometry/trim.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace millwright::project {

namespace {

using exchange::CadFace;
using exchange::TriangleMesh;

constexpr int most_triangles = 300'000; // of all faces together: enough to be recognised
constexpr int most_cells = 24;          // of a patch each way
constexpr int most_trimmed_cells = 96;  // the same of a trimmed one, whose edge is a stair of them

int cells_of_a_patch(const exchange::CadModel& model) {
    std::size_t patches = 0;
    for (const CadFace& face : model.faces) {
        patches += face.patches.size();
    }
    const double each = 0.5 * most_triangles / static_cast<double>(std::max<std::size_t>(patches, 1));
    return std::clamp(static_cast<int>(std::sqrt(each)), 1, most_trimmed_cells);
}

/// The triangles of one patch whose middle lies inside.
void add_patch(
    TriangleMesh& mesh, const CadFace& face, int row, int column, int cells, const geometry::Trim& trim) {
    const geometry::BezierPatch& patch = face.patches[static_cast<std::size_t>(row * face.columns + column)];
    const int base = static_cast<int>(mesh.points.size());
    const auto share = [cells](double k) { return k / cells; };
    for (int i = 0; i <= cells; ++i) {
        for (int j = 0; j <= cells; ++j) {
            mesh.points.push_back(patch.position(share(i), share(j)));
        }
    }
    const auto inside = [&](double i, double j) {
        return trim.contains({(row + share(i)) / face.rows, (column + share(j)) / face.columns});
    };
    for (int i = 0; i < cells; ++i) {
        for (int j = 0; j < cells; ++j) {
            const int a = base + i * (cells + 1) + j;
            const int b = a + cells + 1;
            if (inside(i + 2.0 / 3.0, j + 1.0 / 3.0)) {
                mesh.triangles.push_back({a, b, b + 1});
            }
            if (inside(i + 1.0 / 3.0, j + 2.0 / 3.0)) {
                mesh.triangles.push_back({a, b + 1, a + 1});
            }
        }
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
        const geometry::Trim trim = face.trim();
        for (int row = 0; row < face.rows; ++row) {
            for (int column = 0; column < face.columns; ++column) {
                add_patch(
                    mesh, face, row, column, face.trimmed() ? cells : std::min(cells, most_cells), trim);
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
