#include "core/region/internal/sheet_equations.h"

#include "core/base/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace millwright::region {

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

[[noreturn]] void refuse_degenerate() {
    throw Error("the faces cannot be spread out flat: their triangles are too thin",
                {},
                "leave out faces that are slivers");
}

SparseMatrix assembled(const FaceMesh& mesh, const Triplets& entries) {
    const Eigen::Index count = std::ssize(mesh.points);
    SparseMatrix matrix(count, count);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

/// The directions from a corner of a triangle to the next two.
struct CornerAngle {
    Vec3 to_next, to_last;

    CornerAngle(const FaceMesh& mesh, const FaceTriangle& triangle, std::size_t k) {
        const auto point = [&](std::size_t n) {
            return mesh.points[static_cast<std::size_t>(triangle.corners[n % 3])];
        };
        to_next = point(k + 1) - point(k);
        to_last = point(k + 2) - point(k);
    }
};

constexpr double least_angle = 1e-6; // rad

} // namespace

SparseMatrix cotangent_matrix(const FaceMesh& mesh) {
    Triplets entries;
    for (const FaceTriangle& triangle : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const CornerAngle at(mesh, triangle, k);
            const double sine = at.to_next.cross(at.to_last).norm();
            const double lengths = at.to_next.norm() * at.to_last.norm();
            const double half = 0.5 * at.to_next.dot(at.to_last) / std::max(sine, least_angle * lengths);
            const int a = triangle.corners[(k + 1) % 3], b = triangle.corners[(k + 2) % 3];
            entries.emplace_back(a, a, half);
            entries.emplace_back(b, b, half);
            entries.emplace_back(a, b, -half);
            entries.emplace_back(b, a, -half);
        }
    }
    return assembled(mesh, entries);
}

SparseMatrix mean_value_matrix(const FaceMesh& mesh) {
    Triplets entries;
    for (const FaceTriangle& triangle : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const CornerAngle at(mesh, triangle, k);
            const double half = std::tan(0.5 * std::max(least_angle, angle_between(at.to_next, at.to_last)));
            const int own = triangle.corners[k];
            const std::array<std::pair<int, double>, 2> others{
                {{triangle.corners[(k + 1) % 3], half / at.to_next.norm()},
                 {triangle.corners[(k + 2) % 3], half / at.to_last.norm()}}};
            for (const auto& [other, weight] : others) {
                entries.emplace_back(own, own, weight);
                entries.emplace_back(own, other, -weight);
            }
        }
    }
    return assembled(mesh, entries);
}

InnerSolver::InnerSolver(const FaceMesh& mesh, const SparseMatrix& matrix, bool symmetric)
    : boundary_(mesh.boundary) {
    std::vector<int> on_boundary(mesh.points.size(), -1);
    for (int n = 0; n < std::ssize(boundary_); ++n) {
        on_boundary[static_cast<std::size_t>(boundary_[static_cast<std::size_t>(n)])] = n;
    }
    inner_.assign(mesh.points.size(), -1);
    int count = 0;
    for (std::size_t n = 0; n < inner_.size(); ++n) {
        if (on_boundary[n] < 0) {
            inner_[n] = count++;
        }
    }
    Triplets inside, outside;
    for (Eigen::Index column = 0; column < matrix.outerSize(); ++column) {
        for (SparseMatrix::InnerIterator entry(matrix, column); entry; ++entry) {
            const int row = inner_[static_cast<std::size_t>(entry.row())];
            const int own = inner_[static_cast<std::size_t>(column)];
            if (row >= 0 && own >= 0) {
                inside.emplace_back(row, own, entry.value());
            } else if (row >= 0) {
                outside.emplace_back(row, on_boundary[static_cast<std::size_t>(column)], entry.value());
            }
        }
    }
    SparseMatrix system(count, count);
    system.setFromTriplets(inside.begin(), inside.end());
    to_boundary_.resize(count, std::ssize(boundary_));
    to_boundary_.setFromTriplets(outside.begin(), outside.end());
    bool solved = false;
    if (symmetric) {
        symmetric_ = std::make_unique<Eigen::SimplicialLDLT<SparseMatrix>>(system);
        solved = symmetric_->info() == Eigen::Success;
    } else {
        system.makeCompressed();
        general_ = std::make_unique<Eigen::SparseLU<SparseMatrix>>(system);
        solved = general_->info() == Eigen::Success;
    }
    if (!solved) {
        refuse_degenerate();
    }
}

InnerSolver::~InnerSolver() = default;
InnerSolver::InnerSolver(InnerSolver&&) noexcept = default;
InnerSolver& InnerSolver::operator=(InnerSolver&&) noexcept = default;

std::vector<Vec2> InnerSolver::solve(const std::vector<Vec2>& boundary) const {
    expects(boundary.size() == boundary_.size(), "each point of the boundary has a place");
    Eigen::MatrixX2d held(std::ssize(boundary), 2);
    for (Eigen::Index n = 0; n < held.rows(); ++n) {
        held.row(n) = boundary[static_cast<std::size_t>(n)].transpose();
    }
    const Eigen::MatrixX2d right = -(to_boundary_ * held);
    Eigen::MatrixX2d found(right.rows(), 2);
    for (int axis = 0; axis < 2; ++axis) {
        const Eigen::VectorXd of_axis = right.col(axis);
        if (symmetric_) {
            found.col(axis) = symmetric_->solve(of_axis);
        } else {
            found.col(axis) = general_->solve(of_axis);
        }
    }
    if (!found.allFinite()) {
        refuse_degenerate();
    }
    std::vector<Vec2> places(inner_.size());
    for (std::size_t n = 0; n < places.size(); ++n) {
        if (inner_[n] >= 0) {
            places[n] = found.row(inner_[n]).transpose();
        }
    }
    for (std::size_t n = 0; n < boundary.size(); ++n) {
        places[static_cast<std::size_t>(boundary_[n])] = boundary[n];
    }
    return places;
}

} // namespace millwright::region
