#include "core/plan/reference_mesh.h"

#include "core/geometry/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace millwright::plan {

namespace {

using exchange::CadFace;
using exchange::TriangleMesh;

constexpr int most_triangles = 300'000; // of all faces together: enough to be recognised
constexpr int most_cells = 24;          // of a patch each way

/// How many triangles the patches that are still to come may have.
class Allowance {
public:
    Allowance(const exchange::CadModel& model, const std::vector<int>& chosen) {
        for (const CadFace& face : model.faces) {
            patches_ += std::ranges::count(chosen, face.number) > 0 ? 0 : std::ssize(face.patches);
        }
        const double each = 0.5 * static_cast<double>(of_a_patch());
        cells_ = std::clamp(static_cast<int>(std::sqrt(each)), 1, most_cells);
    }

    /// Of a patch each way, of all the same: neighbours meet corner to corner.
    [[nodiscard]] int cells() const { return cells_; }
    /// Of the next patch; what those before it did not need is shared out.
    [[nodiscard]] std::ptrdiff_t of_a_patch() const {
        return std::max<std::ptrdiff_t>(triangles_ / std::max<std::ptrdiff_t>(patches_, 1), 2);
    }
    void take(std::ptrdiff_t triangles) {
        --patches_;
        triangles_ -= triangles;
    }

private:
    std::ptrdiff_t patches_ = 0;
    std::ptrdiff_t triangles_ = most_triangles;
    int cells_ = 1;
};

/// Every other corner; a triangle stays.
geometry::Trim::Loop thinned(const geometry::Trim::Loop& loop) {
    geometry::Trim::Loop result;
    const std::size_t corners = std::max<std::size_t>(loop.size() / 2, 3);
    for (std::size_t k = 0; k < corners; ++k) {
        result.push_back(loop[k * loop.size() / corners]);
    }
    return result;
}

std::size_t corners_of(const geometry::Trim& trim) {
    std::size_t corners = 0;
    for (const geometry::Trim::Loop& loop : trim.loops) {
        corners += loop.size();
    }
    return corners;
}

/// With as much of the outline as `most` triangles inside can follow, in that many cells each way or fewer;
/// at last two triangles, the outline unheeded.
geometry::TrimmedSquare square_of(geometry::Trim trim, int cells, std::ptrdiff_t most) {
    while (true) {
        const std::size_t corners = corners_of(trim);
        if (std::cmp_less_equal(corners, most)) { // a corner is a triangle at least
            geometry::TrimmedSquare square = geometry::trimmed_square(trim, cells, cells);
            if (std::ssize(square.inside) <= most) {
                return square;
            }
        }
        std::ranges::transform(trim.loops, trim.loops.begin(), thinned);
        if (cells == 1 && corners_of(trim) == corners) {
            return geometry::trimmed_square({}, 1, 1);
        }
        cells = std::max(cells / 2, 1);
    }
}

/// What lies inside.
void add_patch(TriangleMesh& mesh,
               const geometry::BezierPatch& patch,
               const geometry::TrimmedSquare& square) {
    std::vector<int> points(square.places.size(), -1);
    const auto point = [&](int place) {
        int& number = points[static_cast<std::size_t>(place)];
        if (number < 0) {
            const Vec2& uv = square.places[static_cast<std::size_t>(place)];
            number = static_cast<int>(mesh.points.size());
            mesh.points.push_back(patch.position(uv.x(), uv.y()));
        }
        return number;
    };
    for (const auto& [a, b, c] : square.inside) {
        mesh.triangles.push_back({point(a), point(b), point(c)});
    }
}

void add_face(TriangleMesh& mesh, const CadFace& face, Allowance& allowance) {
    for (int row = 0; row < face.rows; ++row) {
        for (int column = 0; column < face.columns; ++column) {
            geometry::TrimmedSquare square;
            if (auto trim = face.trim_of(row, column)) {
                const auto patch = static_cast<std::size_t>(row * face.columns + column);
                square = square_of(*std::move(trim), allowance.cells(), allowance.of_a_patch());
                add_patch(mesh, face.patches[patch], square);
            }
            allowance.take(std::ssize(square.inside));
        }
    }
}

void add_faces_but(ReferenceMesh& reference,
                   const exchange::CadModel& model,
                   const std::vector<int>& chosen,
                   const Progress& progress) {
    TriangleMesh& mesh = reference.rest;
    Allowance allowance(model, chosen);
    for (const CadFace& face : model.faces) {
        progress.check();
        if (std::ranges::count(chosen, face.number) == 0) {
            add_face(mesh, face, allowance);
            reference.faces.resize(mesh.triangles.size(), face.number);
        }
    }
}

} // namespace

ReferenceMesh reference_mesh(const project::ImportSource& source,
                             const project::ImportChoice& choice,
                             const project::ImportedSurface* imported,
                             const Progress& progress) {
    ReferenceMesh reference;
    if (imported != nullptr && imported->points) {
        reference.fitted.points = imported->points->points;
        reference.deviation = imported->points->deviation.at_points;
        reference.largest = imported->points->deviation.max;
    } else if (source.points) {
        reference.rest.points = source.points->points;
        for (Vec3& point : reference.rest.points) {
            point *= choice.mm_per_unit;
        }
    } else if (imported != nullptr && imported->fit && !imported->fit->side.triangles.empty()) {
        const exchange::MeshFit& fit = *imported->fit;
        reference.fitted = fit.side;
        reference.deviation = fit.deviation.at_points;
        reference.largest = fit.deviation.max;
        reference.rest = fit.left_out;
    } else if (source.mesh) {
        reference.rest = scaled(source.mesh->mesh, choice.mm_per_unit);
    }
    if (source.model) {
        reference.rest = {};
        add_faces_but(reference,
                      *source.model,
                      imported != nullptr ? chosen_faces(*source.model, choice) : std::vector<int>{},
                      progress);
    }
    return reference;
}

} // namespace millwright::plan
