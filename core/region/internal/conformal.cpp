// Least squares conformal map with a free boundary. Two points of it are held, the others follow.
#include "core/base/error.h"
#include "core/region/flattening.h"
#include "core/region/internal/distortion.h"
#include "core/region/internal/sheet_equations.h"

#include <Eigen/SparseCholesky>

#include <array>
#include <cmath>
#include <vector>

namespace millwright::region {

namespace {

/// Dirichlet energy less area, both halved: [2 points x 2 points], x of all points before y.
SparseMatrix conformal_matrix(const FaceMesh& mesh) {
    const int count = static_cast<int>(mesh.points.size());
    const SparseMatrix dirichlet = cotangent_matrix(mesh);
    std::vector<Eigen::Triplet<double>> entries;
    for (Eigen::Index column = 0; column < dirichlet.outerSize(); ++column) {
        for (SparseMatrix::InnerIterator entry(dirichlet, column); entry; ++entry) {
            const auto row = static_cast<int>(entry.row()), own = static_cast<int>(column);
            entries.emplace_back(row, own, entry.value());
            entries.emplace_back(row + count, own + count, entry.value());
        }
    }
    // The area is half the sum of x_a y_b - x_b y_a along the boundary.
    for (std::size_t n = 0; n < mesh.boundary.size(); ++n) {
        const int a = mesh.boundary[n], b = mesh.boundary[(n + 1) % mesh.boundary.size()];
        entries.emplace_back(a, b + count, -0.5);
        entries.emplace_back(b + count, a, -0.5);
        entries.emplace_back(b, a + count, 0.5);
        entries.emplace_back(a + count, b, 0.5);
    }
    SparseMatrix matrix(2 * count, 2 * count);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

/// The first point of the boundary and that farthest from it.
std::array<int, 2> held_points(const FaceMesh& mesh) {
    const auto& point = [&](int n) -> const Vec3& { return mesh.points[static_cast<std::size_t>(n)]; };
    const int first = mesh.boundary.front();
    int last = first;
    for (const int n : mesh.boundary) {
        if ((point(n) - point(first)).norm() > (point(last) - point(first)).norm()) {
            last = n;
        }
    }
    return {first, last};
}

/// The solution with four unknowns held at `values`.
Eigen::VectorXd
solved(const SparseMatrix& matrix, const std::array<int, 4>& held, const std::array<double, 4>& values) {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(matrix.rows());
    std::vector<int> place(static_cast<std::size_t>(matrix.rows()), 0);
    for (std::size_t k = 0; k < held.size(); ++k) {
        all[held[k]] = values[k];
        place[static_cast<std::size_t>(held[k])] = -1;
    }
    int count = 0;
    for (int& n : place) {
        n = n < 0 ? -1 : count++;
    }
    std::vector<Eigen::Triplet<double>> entries;
    const Eigen::VectorXd moved = matrix * all;
    Eigen::VectorXd right(count);
    for (Eigen::Index column = 0; column < matrix.outerSize(); ++column) {
        const int own = place[static_cast<std::size_t>(column)];
        if (own < 0) {
            continue;
        }
        right[own] = -moved[column];
        for (SparseMatrix::InnerIterator entry(matrix, column); entry; ++entry) {
            if (const int row = place[static_cast<std::size_t>(entry.row())]; row >= 0) {
                entries.emplace_back(row, own, entry.value());
            }
        }
    }
    SparseMatrix inside(count, count);
    inside.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<SparseMatrix> factors(inside);
    Eigen::VectorXd found;
    if (factors.info() == Eigen::Success) {
        found = factors.solve(right);
    }
    if (found.size() != count || !found.allFinite()) {
        throw Error("the faces cannot be spread out flat: their triangles are too thin",
                    {},
                    "leave out faces that are slivers");
    }
    for (std::size_t n = 0; n < place.size(); ++n) {
        if (place[n] >= 0) {
            all[static_cast<Eigen::Index>(n)] = found[place[n]];
        }
    }
    return all;
}

double area_of(const FaceMesh& mesh) {
    double sum = 0.0;
    for (const FaceTriangle& triangle : mesh.triangles) {
        const auto point = [&](std::size_t k) {
            return mesh.points[static_cast<std::size_t>(triangle.corners[k])];
        };
        sum += 0.5 * (point(1) - point(0)).cross(point(2) - point(0)).norm();
    }
    return sum;
}

/// As large as the sheet.
void scale(const FaceMesh& mesh, std::vector<Vec2>& places) {
    double flat = 0.0;
    for (const FaceTriangle& triangle : mesh.triangles) {
        const auto place = [&](std::size_t k) {
            return places[static_cast<std::size_t>(triangle.corners[k])];
        };
        flat += 0.5 * std::abs(cross(place(1) - place(0), place(2) - place(0)));
    }
    const double factor = std::sqrt(area_of(mesh) / flat);
    for (Vec2& place : places) {
        place *= factor;
    }
}

} // namespace

Flattening conformal(const FaceMesh& mesh) {
    const int count = static_cast<int>(mesh.points.size());
    const auto [first, last] = held_points(mesh);
    const Eigen::VectorXd found =
        solved(conformal_matrix(mesh), {first, last, first + count, last + count}, {0.0, 1.0, 0.0, 0.0});
    Flattening flat;
    flat.method = FlatteningMethod::conformal;
    for (int n = 0; n < count; ++n) {
        flat.places.emplace_back(found[n], found[n + count]);
    }
    scale(mesh, flat.places);
    measure(mesh, flat);
    return flat;
}

} // namespace millwright::region
