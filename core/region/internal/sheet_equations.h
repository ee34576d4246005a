// The sparse equations by which the places of a sheet's points follow those of its boundary.
#pragma once

#include "core/region/face_mesh.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <Eigen/SparseLU>

#include <memory>
#include <vector>

namespace millwright::region {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// Half of the cotangent opposite to each edge, by the triangles' shapes in space: the matrix of the
/// Dirichlet energy, [points x points]. An angle below a millionth of a radian counts as that.
[[nodiscard]] SparseMatrix cotangent_matrix(const FaceMesh& mesh);

/// Rows of Floater's weights, [points x points].
[[nodiscard]] SparseMatrix mean_value_matrix(const FaceMesh& mesh);

/// Places of all points from those of the boundary: factored once for any of them.
class InnerSolver {
public:
    /// `symmetric`: the matrix is that and positive where the boundary is held.
    InnerSolver(const FaceMesh& mesh, const SparseMatrix& matrix, bool symmetric);
    ~InnerSolver();
    InnerSolver(InnerSolver&&) noexcept;
    InnerSolver& operator=(InnerSolver&&) noexcept;

    /// `boundary`: of the points of mesh.boundary, in its order. Throws Error without a solution.
    [[nodiscard]] std::vector<Vec2> solve(const std::vector<Vec2>& boundary) const;

private:
    std::vector<int> boundary_;
    std::vector<int> inner_;   ///< per point its number among those inside, or -1
    SparseMatrix to_boundary_; ///< [inside x boundary]
    std::unique_ptr<Eigen::SimplicialLDLT<SparseMatrix>> symmetric_;
    std::unique_ptr<Eigen::SparseLU<SparseMatrix>> general_;
};

} // namespace millwright::region
