// The nearest point of a triangle mesh, by a tree of boxes. The nearest point of one triangle: Ericson 2005,
// Real-Time Collision Detection, ch. 5.1.5.
#pragma once

#include "core/exchange/triangle_mesh.h"

#include <cstddef>
#include <vector>

namespace millwright::exchange {

struct NearestTriangle {
    std::size_t triangle = 0;
    Vec3 shares = Vec3::Zero(); ///< of its corners at the nearest point; their sum is 1
    double distance = 0.0;      ///< mm
};

/// Const after construction; may be called from several threads. Refers to the mesh.
class TriangleSearch {
public:
    /// Throws Defect for a mesh without triangles.
    explicit TriangleSearch(const TriangleMesh& mesh);

    [[nodiscard]] NearestTriangle nearest(const Vec3& point) const;

private:
    /// Its first half is the next node, its second half the node `second`.
    struct Node {
        Box3 box;
        std::size_t first = 0, last = 0; ///< of its triangles in `order_`
        std::size_t second = 0;          ///< 0 for a leaf
    };

    const TriangleMesh* mesh_;
    std::vector<std::size_t> order_; ///< of the triangles
    std::vector<Node> nodes_;

    void build(std::size_t first, std::size_t last);
    void search(std::size_t node, const Vec3& point, NearestTriangle& best) const;
};

} // namespace millwright::exchange
