// Triangles in a tree of boxes, and how near or how deep other bodies are to them. Bodies of revolution are
// taken as they are, by their section: their distance is a convex function of the point, so that its tangent
// at the middle of a box or a triangle bounds what lies in it. Mesh against mesh is FCL's. Lengths mm.
#pragma once

#include "core/geometry/tool_pose.h"
#include "core/toolpath/profile.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace millwright::simulation {

class FclMesh;

struct CollisionTriangles {
    std::vector<Vec3> points;
    std::vector<std::array<int, 3>> triangles; ///< indices
};

/// What is near another body, and where.
struct NearPlace {
    double distance = 0.0;     ///< below 0: so deep in a body of revolution
    Vec3 place = Vec3::Zero(); ///< on this mesh, in its coordinates
};

class CollisionMesh {
public:
    /// Throws Defect without a triangle, for an index outside, and for coordinates that are not finite.
    explicit CollisionMesh(CollisionTriangles triangles);
    ~CollisionMesh();
    CollisionMesh(const CollisionMesh&) = delete;
    CollisionMesh& operator=(const CollisionMesh&) = delete;

    [[nodiscard]] const CollisionTriangles& surface() const { return surface_; }
    [[nodiscard]] const Box3& box() const { return box_; }

    /// What a search for the nearest point may leave out.
    struct Wanted {
        double below = 0.0;      ///< distances that are not below do not matter
        double settled = -1e300; ///< once one is not above this, the rest does not matter
        double tolerance = 2e-4; ///< by how much a distance may be too large, or a tenth of itself if more
    };
    /// The point of the triangles that is nearest to the body, or deepest in it; nullopt where none is below
    /// what is wanted.
    [[nodiscard]] std::optional<NearPlace>
    nearest(const toolpath::Profile& body, const geometry::ToolPose& pose, const Wanted& wanted) const;
    /// By how much such a distance can be too large.
    [[nodiscard]] static double slack(double distance, double tolerance);

    /// The distance to another mesh, 0 where they cross; nullopt where it is not below `enough`. The place is
    /// on this one. A mesh within another one crosses nothing.
    [[nodiscard]] std::optional<NearPlace>
    nearest(const CollisionMesh& other, const Frame& this_T_other, double enough) const;

    /// From a point to the triangles, below 0 where an odd number of them lies on a line outwards: inside of
    /// a closed mesh.
    [[nodiscard]] double signed_distance(const Vec3& point) const;

    /// How deep points of `other` lie within this closed mesh: of the deepest that was found with so many
    /// looks; nullopt if none lies inside. The place is in the coordinates of this one.
    [[nodiscard]] std::optional<NearPlace>
    deepest(const CollisionMesh& other, const Frame& this_T_other, int looks) const;

private:
    struct Node {
        Vec3 center = Vec3::Zero(), half = Vec3::Zero();
        double radius = 0.0;
        std::int32_t next = 0;  // of the second child; the first follows its parent. Of a leaf its triangle
        std::int32_t count = 0; // triangles of a leaf; 0: no leaf
    };
    struct Search;
    void build(std::int32_t first, std::int32_t count);
    void search_triangle(std::array<Vec3, 3> corners, Search& search) const;
    [[nodiscard]] std::array<Vec3, 3> corners(std::int32_t triangle) const;

    CollisionTriangles surface_;
    Box3 box_;
    std::vector<Node> nodes_;
    std::unique_ptr<const FclMesh> fcl_;
};

} // namespace millwright::simulation
