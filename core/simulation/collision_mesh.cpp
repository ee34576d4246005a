#include "core/simulation/collision_mesh.h"

#include "core/base/error.h"
#include "core/simulation/internal/fcl_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

namespace millwright::simulation {

namespace {

constexpr std::int32_t triangles_per_leaf = 4;
constexpr double infinite = std::numeric_limits<double>::infinity();

/// The distance of a point to a body of revolution and its gradient.
struct Seen {
    double distance = 0.0;
    Vec3 normal = Vec3::UnitZ();
};

Seen seen_from(const toolpath::Profile& body, const geometry::ToolPose& pose, const Vec3& point) {
    const Vec3 from_tip = point - pose.tip;
    const double z = from_tip.dot(pose.axis);
    const Vec3 radial = from_tip - z * pose.axis;
    const double rho = radial.norm();
    const toolpath::Profile::Near near = body.near({rho, z});
    const Vec3 outwards = rho > 0.0 ? Vec3(radial / rho) : Vec3::Zero();
    return {near.distance, near.normal.x() * outwards + near.normal.y() * pose.axis};
}

/// A lower bound of the distance: that to the cylinder around the body.
double bound_from(const toolpath::Profile& body, const geometry::ToolPose& pose, const Vec3& point) {
    const toolpath::ProfileShape& shape = body.shape();
    const Vec3 from_tip = point - pose.tip;
    const double z = from_tip.dot(pose.axis);
    const double beside = std::sqrt(std::max(from_tip.squaredNorm() - z * z, 0.0)) - shape.radius;
    const double along = std::max(shape.bottom - z, z - shape.top);
    return beside > 0.0 && along > 0.0 ? std::hypot(beside, along) : std::max(beside, along);
}

/// The point of a triangle that is nearest to `p` (Ericson, Real-Time Collision Detection, 5.1.5).
Vec3 nearest_on(const std::array<Vec3, 3>& t, const Vec3& p) {
    const Vec3 ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0];
    const double d1 = ab.dot(ap), d2 = ac.dot(ap);
    if (d1 <= 0.0 && d2 <= 0.0) {
        return t[0];
    }
    const Vec3 bp = p - t[1];
    const double d3 = ab.dot(bp), d4 = ac.dot(bp);
    if (d3 >= 0.0 && d4 <= d3) {
        return t[1];
    }
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
        return t[0] + d1 / (d1 - d3) * ab;
    }
    const Vec3 cp = p - t[2];
    const double d5 = ab.dot(cp), d6 = ac.dot(cp);
    if (d6 >= 0.0 && d5 <= d6) {
        return t[2];
    }
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
        return t[0] + d2 / (d2 - d6) * ac;
    }
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
        return t[1] + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (t[2] - t[1]);
    }
    const double whole = va + vb + vc;
    return whole > 0.0 ? Vec3(t[0] + vb / whole * ab + vc / whole * ac) : t[0];
}

/// Whether the line from `p` along `d` meets the triangle (Moeller and Trumbore).
bool meets(const std::array<Vec3, 3>& t, const Vec3& p, const Vec3& d) {
    const Vec3 e1 = t[1] - t[0], e2 = t[2] - t[0];
    const Vec3 h = d.cross(e2);
    const double a = e1.dot(h);
    if (!(std::abs(a) > 0.0)) {
        return false;
    }
    const Vec3 s = p - t[0];
    const double u = s.dot(h) / a;
    const Vec3 q = s.cross(e1);
    const double v = d.dot(q) / a;
    return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && e2.dot(q) / a > 0.0;
}

bool line_meets(const Vec3& center, const Vec3& half, const Vec3& p, const Vec3& d) {
    double from = 0.0, to = infinite;
    for (int k = 0; k < 3; ++k) {
        const double one = (center[k] - half[k] - p[k]) / d[k];
        const double other = (center[k] + half[k] - p[k]) / d[k];
        from = std::max(from, std::min(one, other));
        to = std::min(to, std::max(one, other));
    }
    return from <= to;
}

std::size_t longest_edge(const std::array<Vec3, 3>& t) {
    std::size_t longest = 0;
    double square = -1.0;
    for (std::size_t n = 0; n < 3; ++n) {
        const double length = (t[(n + 1) % 3] - t[n]).squaredNorm();
        if (length > square) {
            square = length;
            longest = n;
        }
    }
    return longest;
}

/// The two halves of a triangle, cut across its longest edge.
std::array<std::array<Vec3, 3>, 2> halves(const std::array<Vec3, 3>& t) {
    const std::size_t n = longest_edge(t);
    const Vec3 middle = 0.5 * (t[n] + t[(n + 1) % 3]);
    return {{{t[n], middle, t[(n + 2) % 3]}, {middle, t[(n + 1) % 3], t[(n + 2) % 3]}}};
}

std::array<Vec3, 3> corners_of(const std::array<int, 3>& triangle, const std::vector<Vec3>& points) {
    std::array<Vec3, 3> t;
    for (std::size_t k = 0; k < 3; ++k) {
        t.at(k) = points[static_cast<std::size_t>(triangle.at(k))];
    }
    return t;
}

/// Which triangles have boxes that meet `box`.
std::vector<std::size_t> reaching_into(const Box3& box,
                                       const std::vector<std::array<int, 3>>& triangles,
                                       const std::vector<Vec3>& points) {
    std::vector<std::size_t> reaching;
    for (std::size_t n = 0; n < triangles.size(); ++n) {
        Box3 around;
        for (const Vec3& corner : corners_of(triangles[n], points)) {
            around.extend(corner);
        }
        if (around.intersects(box)) {
            reaching.push_back(n);
        }
    }
    return reaching;
}

} // namespace

/// The nearest place so far, and what is still worth a look.
struct CollisionMesh::Search {
    const toolpath::Profile& body;
    const geometry::ToolPose& pose;
    const Wanted& wanted;
    double enough = wanted.below; ///< what is not below is left out
    NearPlace best{infinite, Vec3::Zero()};

    void look(const Vec3& point, double distance) {
        if (!(distance < best.distance)) {
            return;
        }
        best = {distance, point};
        if (distance < wanted.below) { // a place beyond says nothing of those that are wanted
            enough = distance <= wanted.settled
                         ? -infinite
                         : std::min(enough, distance - slack(distance, wanted.tolerance));
        }
    }
};

double CollisionMesh::slack(double distance, double tolerance) {
    constexpr double share = 0.1;
    return std::max(tolerance, share * distance);
}

CollisionMesh::CollisionMesh(CollisionTriangles triangles) : surface_(std::move(triangles)) {
    expects(!surface_.triangles.empty(), "a mesh has a triangle");
    for (const Vec3& point : surface_.points) {
        expects(is_finite(point), "a mesh has finite points");
        box_.extend(point);
    }
    const auto count = static_cast<int>(surface_.points.size());
    for (const auto& triangle : surface_.triangles) {
        for (const int corner : triangle) {
            expects(corner >= 0 && corner < count, "a triangle names a point of its mesh");
        }
    }
    nodes_.reserve(surface_.triangles.size());
    build(0, static_cast<std::int32_t>(surface_.triangles.size()));
    fcl_ = std::make_unique<FclMesh>(surface_);
}

CollisionMesh::~CollisionMesh() = default;

std::array<Vec3, 3> CollisionMesh::corners(std::int32_t triangle) const {
    const auto& [a, b, c] = surface_.triangles[static_cast<std::size_t>(triangle)];
    return {surface_.points[static_cast<std::size_t>(a)],
            surface_.points[static_cast<std::size_t>(b)],
            surface_.points[static_cast<std::size_t>(c)]};
}

void CollisionMesh::build(std::int32_t first, std::int32_t count) {
    Box3 box, middles;
    for (std::int32_t n = first; n < first + count; ++n) {
        const auto t = corners(n);
        for (const Vec3& corner : t) {
            box.extend(corner);
        }
        middles.extend(Vec3((t[0] + t[1] + t[2]) / 3.0));
    }
    const std::size_t at = nodes_.size();
    Node node;
    node.center = box.center();
    node.half = 0.5 * box.sizes();
    node.radius = node.half.norm();
    nodes_.push_back(node);
    if (count <= triangles_per_leaf) {
        nodes_[at].next = first;
        nodes_[at].count = count;
        return;
    }
    int axis = 0;
    middles.sizes().maxCoeff(&axis);
    const auto middle_of = [&](const std::array<int, 3>& t) {
        double sum = 0.0;
        for (const int corner : t) {
            sum += surface_.points[static_cast<std::size_t>(corner)][axis];
        }
        return sum;
    };
    const auto begin = surface_.triangles.begin() + first;
    std::nth_element(begin, begin + count / 2, begin + count, [&](const auto& a, const auto& b) {
        return middle_of(a) < middle_of(b);
    });
    build(first, count / 2);
    nodes_[at].next = static_cast<std::int32_t>(nodes_.size());
    build(first + count / 2, count - count / 2);
}

void CollisionMesh::search_triangle(std::array<Vec3, 3> first, Search& search) const {
    constexpr std::size_t deepest = 64;
    std::array<std::array<Vec3, 3>, deepest> left; // still to be looked at
    std::size_t count = 0;
    left[count++] = first;
    while (count > 0) {
        const std::array<Vec3, 3> t = left[--count];
        const Vec3 center = (t[0] + t[1] + t[2]) / 3.0;
        const Seen seen = seen_from(search.body, search.pose, center);
        search.look(center, seen.distance);
        std::array<double, 3> tangent{};
        for (std::size_t n = 0; n < 3; ++n) {
            tangent[n] = seen.distance + seen.normal.dot(t[n] - center);
        }
        const auto lowest = static_cast<std::size_t>(std::ranges::min_element(tangent) - tangent.begin());
        if (tangent[lowest] >= search.enough) {
            continue;
        }
        const Vec3& corner = t[lowest];
        search.look(corner, seen_from(search.body, search.pose, corner).distance);
        if (tangent[lowest] >= search.enough || count + 2 > deepest) {
            continue;
        }
        for (const auto& half : halves(t)) {
            left[count++] = half;
        }
    }
}

std::optional<NearPlace> CollisionMesh::nearest(const toolpath::Profile& body,
                                                const geometry::ToolPose& pose,
                                                const Wanted& wanted) const {
    Search search{.body = body, .pose = pose, .wanted = wanted};
    constexpr std::size_t deepest = 64;
    struct Waiting {
        std::int32_t node = 0;
        double bound = 0.0;
    };
    const auto bound = [&](const Node& node) {
        const double rough = bound_from(body, pose, node.center) - node.radius;
        if (rough >= search.enough) {
            return rough;
        }
        const Seen seen = seen_from(body, pose, node.center);
        return seen.distance - seen.normal.cwiseAbs().dot(node.half);
    };
    std::array<Waiting, deepest> left;
    std::size_t count = 0;
    left[count++] = {0, bound(nodes_.front())};
    while (count > 0) {
        const Waiting now = left[--count];
        if (now.bound >= search.enough) {
            continue;
        }
        const Node& node = nodes_[static_cast<std::size_t>(now.node)];
        for (std::int32_t n = 0; n < node.count; ++n) {
            search_triangle(corners(node.next + n), search);
        }
        if (node.count == 0) {
            Waiting one{now.node + 1, bound(nodes_[static_cast<std::size_t>(now.node) + 1])};
            Waiting other{node.next, bound(nodes_[static_cast<std::size_t>(node.next)])};
            if (one.bound < other.bound) {
                std::swap(one, other);
            }
            left.at(count++) = one;
            left.at(count++) = other;
        }
    }
    return search.best.distance < wanted.below ? std::optional(search.best) : std::nullopt;
}

std::optional<NearPlace>
CollisionMesh::nearest(const CollisionMesh& other, const Frame& this_T_other, double enough) const {
    return fcl_->nearest(*other.fcl_, this_T_other, enough);
}

double CollisionMesh::signed_distance(const Vec3& point) const {
    double square = infinite;
    std::size_t crossings = 0;
    const Vec3 outwards(0.283, 0.139, 0.949); // along no edge that people draw
    // Two ways through the tree, since the nearest triangle is soon found if the nearer child goes first.
    constexpr std::size_t most = 64;
    const auto off = [&](std::int32_t at) {
        const Node& node = nodes_[static_cast<std::size_t>(at)];
        return ((point - node.center).cwiseAbs() - node.half).cwiseMax(0.0).squaredNorm();
    };
    std::array<std::pair<std::int32_t, double>, most> near;
    std::size_t count = 0;
    near[count++] = {0, off(0)};
    while (count > 0) {
        const auto [at, bound] = near[--count];
        if (bound >= square) {
            continue;
        }
        const Node& node = nodes_[static_cast<std::size_t>(at)];
        for (std::int32_t n = 0; n < node.count; ++n) {
            square = std::min(square, (nearest_on(corners(node.next + n), point) - point).squaredNorm());
        }
        if (node.count == 0) {
            std::pair one{at + 1, off(at + 1)}, other{node.next, off(node.next)};
            if (one.second < other.second) {
                std::swap(one, other);
            }
            near.at(count++) = one;
            near.at(count++) = other;
        }
    }
    std::array<std::int32_t, most> met;
    met[count++] = 0;
    while (count > 0) {
        const std::int32_t at = met[--count];
        const Node& node = nodes_[static_cast<std::size_t>(at)];
        if (!line_meets(node.center, node.half, point, outwards)) {
            continue;
        }
        for (std::int32_t n = 0; n < node.count; ++n) {
            crossings += meets(corners(node.next + n), point, outwards) ? 1 : 0;
        }
        if (node.count == 0) {
            met.at(count++) = node.next;
            met.at(count++) = at + 1;
        }
    }
    return crossings % 2 == 1 ? -std::sqrt(square) : std::sqrt(square);
}

std::optional<NearPlace>
CollisionMesh::deepest(const CollisionMesh& other, const Frame& this_T_other, int looks) const {
    struct Piece {
        std::array<Vec3, 3> corners;
        double bound = 0.0; // nothing in it is deeper
        bool operator<(const Piece& piece) const { return bound < piece.bound; }
    };
    std::priority_queue<Piece> left;
    NearPlace best{0.0, Vec3::Zero()};
    constexpr double exact = 1e-3; // mm
    const auto look = [&](const std::array<Vec3, 3>& t, double cap) {
        const Vec3 center = (t[0] + t[1] + t[2]) / 3.0;
        double radius = 0.0;
        for (const Vec3& corner : t) {
            radius = std::max(radius, (corner - center).norm());
        }
        const double outside = box_.exteriorDistance(center);
        const double depth = outside > 0.0 ? -outside : -signed_distance(center);
        if (depth > best.distance) {
            best = {depth, center};
        }
        left.push({t, std::min(cap, depth + radius)});
    };
    std::vector<Vec3> points;
    std::vector<std::size_t> near; // points in the box, then triangles that reach it
    points.reserve(other.surface_.points.size());
    for (const Vec3& point : other.surface_.points) {
        points.push_back(this_T_other * point);
        if (box_.contains(points.back())) {
            near.push_back(points.size() - 1);
        }
    }
    const auto step_over = [&](std::size_t count) {
        const auto most = static_cast<std::size_t>(10 * looks);
        return count / most + 1;
    };
    for (std::size_t n = 0; n < near.size(); n += step_over(near.size())) {
        const Vec3& point = points[near[n]];
        const double depth = -signed_distance(point);
        if (depth > best.distance) {
            best = {depth, point};
        }
    }
    near = reaching_into(box_, other.surface_.triangles, points);
    for (std::size_t n = 0; n < near.size(); n += step_over(near.size())) {
        look(corners_of(other.surface_.triangles[near[n]], points), infinite);
    }
    for (int n = 0; n < looks && !left.empty() && left.top().bound > best.distance + exact; ++n) {
        const Piece piece = left.top();
        left.pop();
        for (const auto& half : halves(piece.corners)) {
            look(half, piece.bound);
        }
    }
    return best.distance > 0.0 ? std::optional(best) : std::nullopt;
}

} // namespace millwright::simulation
