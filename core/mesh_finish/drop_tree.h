// Triangles sorted for one tool axis, and where a cutter rests on them exactly: on a corner, an edge or a
// facet, whichever is met first from above. Frame: the tool's axis is +Z (pass_frame in finishing.h). Lengths
// mm.
#pragma once

#include "core/base/progress.h"
#include "core/exchange/triangle_mesh.h"
#include "core/mesh_finish/cutter_outline.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace millwright::mesh_finish {

/// A cutter that rests on the mesh.
struct Drop {
    double z = 0.0; ///< of its tip
    Vec3 contact = Vec3::Zero();
    /// Of the surface that the tip moves on here: d z / d x and d z / d y; infinite where it is upright.
    Vec2 slope = Vec2::Zero();
    int triangle = -1;         ///< of the mesh
    bool on_open_edge = false; ///< the contact lies on an edge that has one triangle
};

class DropTree {
public:
    /// Both sides of a triangle stop a cutter. `open_edges`: bit k for the edge from corner k, one entry per
    /// triangle; or empty. Throws Defect unless all points are finite; Cancelled.
    DropTree(exchange::TriangleMesh mesh, std::vector<std::uint8_t> open_edges, const Progress& progress);

    [[nodiscard]] const exchange::TriangleMesh& mesh() const { return mesh_; }
    [[nodiscard]] const Box3& box() const { return box_; }

    /// Lowered along the axis through `at` until it touches; nothing where it passes by.
    [[nodiscard]] std::optional<Drop> drop(const CutterOutline& cutter, const Vec2& at) const;

    /// No triangle within `radius` of the straight way between two places, seen along the axis, is higher;
    /// nothing where there is none. From above, by at most the height of a triangle.
    [[nodiscard]] std::optional<double> highest_near(const Vec2& from, const Vec2& to, double radius) const;

    /// Bytes that a tree of so many triangles and points takes, and the mesh that it was made of.
    [[nodiscard]] static std::size_t memory(std::size_t triangles, std::size_t points);

private:
    struct Node {
        Eigen::AlignedBox2d box;
        double top = 0.0;
        int first = 0; ///< of a leaf its first triangle in order_, else its second child; the first is next
        int count = 0; ///< of a leaf; 0: no leaf
    };
    class Search;

    void build(int first, int last, const Progress& progress);
    [[nodiscard]] Node node_of(int first, int last) const;

    exchange::TriangleMesh mesh_;
    std::vector<std::uint8_t> open_edges_;
    Box3 box_;
    std::vector<int> order_;
    std::vector<Node> nodes_;
};

} // namespace millwright::mesh_finish
