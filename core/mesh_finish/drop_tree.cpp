#include "core/mesh_finish/drop_tree.h"

#include "core/base/error.h"
#include "core/base/numbers.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace millwright::mesh_finish {

namespace {

constexpr int triangles_of_leaf = 4;
constexpr int deepest = 64; // halves: more triangles than there is memory for

/// Above what rounding does to a contact inside a triangle of ordinary size, as a share of its area.
constexpr double on_border = 1e-12;

/// Whether `p` lies in a triangle seen along the axis. All three turns have one sign there.
bool covers(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
    const Vec2 q = p.head<2>();
    const double ab = cross(b.head<2>() - a.head<2>(), q - a.head<2>());
    const double bc = cross(c.head<2>() - b.head<2>(), q - b.head<2>());
    const double ca = cross(a.head<2>() - c.head<2>(), q - c.head<2>());
    const double rounding = on_border * std::abs(ab + bc + ca);
    return (ab >= rounding && bc >= rounding && ca >= rounding) ||
           (ab <= -rounding && bc <= -rounding && ca <= -rounding);
}

double distance_of_segment(const Eigen::AlignedBox2d& box, const Vec2& from, const Vec2& to) {
    // Of the ball around the box, from below: near enough for choosing what to look at.
    const Vec2 span = to - from;
    const double square_length = span.squaredNorm();
    const double t = square_length > 0.0 ? (box.center() - from).dot(span) / square_length : 0.0;
    const double away = (box.center() - from - std::clamp(t, 0.0, 1.0) * span).norm();
    return away - 0.5 * box.diagonal().norm();
}

} // namespace

/// One cutter lowered at one place: branch and bound, the highest first.
class DropTree::Search {
public:
    Search(const DropTree& tree, const CutterOutline& cutter, const Vec2& at)
        : tree_(tree), cutter_(cutter), at_(at) {}

    std::optional<Drop> found() {
        if (tree_.nodes_.empty()) {
            return std::nullopt;
        }
        push(0);
        while (count_ > 0) {
            const Open open = open_[static_cast<std::size_t>(--count_)];
            if (!(open.bound > best_.z)) {
                continue;
            }
            const Node& node = tree_.nodes_[static_cast<std::size_t>(open.node)];
            for (int n = 0; n < node.count; ++n) {
                look_at(tree_.order_[static_cast<std::size_t>(node.first + n)]);
            }
            if (node.count == 0) {
                push_children(open.node + 1, node.first);
            }
        }
        return best_.triangle < 0 ? std::nullopt : std::optional(best_);
    }

private:
    struct Open {
        int node = 0;
        double bound = 0.0;
    };

    /// No tip over a triangle of the node is higher.
    [[nodiscard]] double bound_of(const Node& node) const {
        const double away = node.box.exteriorDistance(at_);
        return away > cutter_.radius() ? -infinity : node.top - cutter_.height(away);
    }
    void push(int node, double bound) {
        if (bound > best_.z) {
            open_[static_cast<std::size_t>(count_++)] = {node, bound};
        }
    }
    void push(int node) { push(node, bound_of(tree_.nodes_[static_cast<std::size_t>(node)])); }
    void push_children(int a, int b) {
        const double bound_a = bound_of(tree_.nodes_[static_cast<std::size_t>(a)]);
        const double bound_b = bound_of(tree_.nodes_[static_cast<std::size_t>(b)]);
        const bool a_first = bound_a >= bound_b;
        push(a_first ? b : a, a_first ? bound_b : bound_a);
        push(a_first ? a : b, a_first ? bound_a : bound_b);
    }

    void look_at(int triangle) {
        const auto n = static_cast<std::size_t>(triangle);
        const std::array<Vec3, 3> corner{
            tree_.mesh_.corner(n, 0), tree_.mesh_.corner(n, 1), tree_.mesh_.corner(n, 2)};
        const Vec3 normal = tree_.mesh_.doubled_area(n);
        const std::optional<Rest> facet = cutter_.on_plane(at_, corner[0], normal);
        if (facet && !(facet->z > best_.z)) {
            return; // the plane is above all of the triangle
        }
        if (facet && covers(corner[0], corner[1], corner[2], facet->contact)) {
            best_ = {facet->z, facet->contact, Vec2(-normal.head<2>() / normal.z()), triangle, false};
            return;
        }
        for (unsigned k = 0; k < 3; ++k) {
            const std::optional<Rest> edge = cutter_.on_edge(at_, corner[k], corner[(k + 1) % 3]);
            if (edge && edge->z > best_.z) {
                const bool open = !tree_.open_edges_.empty() && ((tree_.open_edges_[n] >> k) & 1U) != 0;
                best_ = {edge->z, edge->contact, slope_at(edge->contact), triangle, open};
            }
        }
    }

    /// Of the cutter's own surface at a contact that stays where it is.
    [[nodiscard]] Vec2 slope_at(const Vec3& contact) const {
        const Vec2 away = contact.head<2>() - at_;
        const double rho = away.norm();
        return rho > 0.0 ? Vec2(cutter_.slope(std::min(rho, cutter_.radius())) / rho * away) : Vec2::Zero();
    }

    const DropTree& tree_;
    const CutterOutline& cutter_;
    Vec2 at_;
    Drop best_{.z = -infinity};
    std::array<Open, 2 * deepest> open_;
    int count_ = 0;
};

DropTree::DropTree(exchange::TriangleMesh mesh,
                   std::vector<std::uint8_t> open_edges,
                   const Progress& progress)
    : mesh_(std::move(mesh)), open_edges_(std::move(open_edges)) {
    expects(open_edges_.empty() || open_edges_.size() == mesh_.triangles.size(),
            "open edges are named for each triangle");
    for (const Vec3& point : mesh_.points) {
        expects(is_finite(point), "points of a mesh are finite");
        box_.extend(point);
    }
    progress.check();
    order_.resize(mesh_.triangles.size());
    std::iota(order_.begin(), order_.end(), 0);
    if (!order_.empty()) {
        nodes_.reserve(order_.size());
        build(0, static_cast<int>(order_.size()), progress);
    }
}

DropTree::Node DropTree::node_of(int first, int last) const {
    Node node;
    node.top = -infinity;
    for (int n = first; n < last; ++n) {
        for (int k = 0; k < 3; ++k) {
            const Vec3& p = mesh_.corner(static_cast<std::size_t>(order_[static_cast<std::size_t>(n)]), k);
            node.box.extend(Vec2(p.head<2>()));
            node.top = std::max(node.top, p.z());
        }
    }
    return node;
}

void DropTree::build(int first, int last, const Progress& progress) {
    const auto at = nodes_.size();
    nodes_.push_back(node_of(first, last));
    if (last - first <= triangles_of_leaf) {
        nodes_[at].first = first;
        nodes_[at].count = last - first;
        return;
    }
    constexpr int large = 4096;
    if (last - first > large) {
        progress.check();
    }
    const Vec2 size = nodes_[at].box.sizes();
    const int axis = size.x() >= size.y() ? 0 : 1;
    const auto middle_of = [&](int n) {
        const auto t = static_cast<std::size_t>(n);
        return mesh_.corner(t, 0)[axis] + mesh_.corner(t, 1)[axis] + mesh_.corner(t, 2)[axis];
    };
    const int middle = first + (last - first) / 2;
    std::nth_element(
        order_.begin() + first, order_.begin() + middle, order_.begin() + last, [&](int a, int b) {
            const double x = middle_of(a);
            const double y = middle_of(b);
            return x < y || (!(y < x) && a < b);
        });
    build(first, middle, progress);
    const int second = static_cast<int>(nodes_.size());
    build(middle, last, progress);
    nodes_[at].first = second;
}

std::optional<Drop> DropTree::drop(const CutterOutline& cutter, const Vec2& at) const {
    return Search(*this, cutter, at).found();
}

std::optional<double> DropTree::highest_near(const Vec2& from, const Vec2& to, double radius) const {
    double top = -infinity;
    std::vector<int> open;
    if (!nodes_.empty()) {
        open.push_back(0);
    }
    while (!open.empty()) {
        const int at = open.back();
        open.pop_back();
        const Node& node = nodes_[static_cast<std::size_t>(at)];
        if (!(node.top > top) || distance_of_segment(node.box, from, to) > radius) {
            continue;
        }
        if (node.count > 0) {
            top = node.top;
            continue;
        }
        open.push_back(at + 1);
        open.push_back(node.first);
    }
    return top > -infinity ? std::optional(top) : std::nullopt;
}

std::size_t DropTree::memory(std::size_t triangles, std::size_t points) {
    constexpr std::size_t nodes_per_triangle = 1; // 2 / triangles_of_leaf, and what is reserved
    constexpr std::size_t meshes = 2;
    return triangles * (meshes * sizeof(std::array<int, 3>) + sizeof(int) + sizeof(std::uint8_t) +
                        nodes_per_triangle * sizeof(Node)) +
           points * meshes * sizeof(Vec3);
}

} // namespace millwright::mesh_finish
