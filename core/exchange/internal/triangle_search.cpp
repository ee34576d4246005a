#include "core/exchange/internal/triangle_search.h"

#include "core/base/error.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace millwright::exchange {

namespace {

/// 0 where a triangle without area leaves nothing to divide by.
double share_of(double part, double whole) {
    return whole > 0.0 ? part / whole : 0.0;
}

/// The shares of the corners at the point of the triangle that is nearest to `p`.
Vec3 nearest_shares(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = b - a, ac = c - a;
    const double d1 = ab.dot(p - a), d2 = ac.dot(p - a);
    if (d1 <= 0.0 && d2 <= 0.0) {
        return {1.0, 0.0, 0.0};
    }
    const double d3 = ab.dot(p - b), d4 = ac.dot(p - b);
    if (d3 >= 0.0 && d4 <= d3) {
        return {0.0, 1.0, 0.0};
    }
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
        const double t = share_of(d1, d1 - d3);
        return {1.0 - t, t, 0.0};
    }
    const double d5 = ab.dot(p - c), d6 = ac.dot(p - c);
    if (d6 >= 0.0 && d5 <= d6) {
        return {0.0, 0.0, 1.0};
    }
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
        const double t = share_of(d2, d2 - d6);
        return {1.0 - t, 0.0, t};
    }
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
        const double t = share_of(d4 - d3, (d4 - d3) + (d5 - d6));
        return {0.0, 1.0 - t, t};
    }
    const double whole = va + vb + vc;
    const double s = share_of(vb, whole), t = share_of(vc, whole);
    return {1.0 - s - t, s, t};
}

} // namespace

TriangleSearch::TriangleSearch(const TriangleMesh& mesh) : mesh_(&mesh), order_(mesh.triangles.size()) {
    expects(!mesh.triangles.empty(), "a mesh that is searched has triangles");
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    build(0, order_.size());
}

void TriangleSearch::build(std::size_t first, std::size_t last) {
    constexpr std::size_t of_leaf = 8;
    const std::size_t here = nodes_.size();
    nodes_.emplace_back();
    nodes_[here].first = first;
    nodes_[here].last = last;
    Box3 centres;
    const auto centre = [this](std::size_t triangle) -> Vec3 {
        return (mesh_->corner(triangle, 0) + mesh_->corner(triangle, 1) + mesh_->corner(triangle, 2)) / 3.0;
    };
    for (std::size_t n = first; n < last; ++n) {
        for (int k = 0; k < 3; ++k) {
            nodes_[here].box.extend(mesh_->corner(order_[n], k));
        }
        centres.extend(centre(order_[n]));
    }
    if (last - first <= of_leaf) {
        return;
    }
    Eigen::Index axis = 0;
    centres.sizes().maxCoeff(&axis);
    const std::size_t middle = first + (last - first) / 2;
    const auto at = [this](std::size_t n) { return order_.begin() + static_cast<std::ptrdiff_t>(n); };
    std::nth_element(at(first), at(middle), at(last), [&](std::size_t a, std::size_t b) {
        return centre(a)[axis] < centre(b)[axis];
    });
    build(first, middle);
    nodes_[here].second = nodes_.size();
    build(middle, last);
}

void TriangleSearch::search(std::size_t node, const Vec3& point, NearestTriangle& best) const {
    const Node& here = nodes_[node];
    if (here.second == 0) {
        for (std::size_t n = here.first; n < here.last; ++n) {
            const std::size_t t = order_[n];
            const Vec3 &a = mesh_->corner(t, 0), &b = mesh_->corner(t, 1), &c = mesh_->corner(t, 2);
            const Vec3 shares = nearest_shares(point, a, b, c);
            const double distance = (shares.x() * a + shares.y() * b + shares.z() * c - point).norm();
            if (distance < best.distance) {
                best = {t, shares, distance};
            }
        }
        return;
    }
    const auto away = [&](std::size_t n) { return nodes_[n].box.exteriorDistance(point); };
    std::size_t near = node + 1;
    std::size_t far = here.second;
    if (away(far) < away(near)) {
        std::swap(near, far);
    }
    for (const std::size_t half : {near, far}) {
        if (away(half) < best.distance) {
            search(half, point, best);
        }
    }
}

NearestTriangle TriangleSearch::nearest(const Vec3& point) const {
    NearestTriangle best;
    best.distance = std::numeric_limits<double>::infinity();
    search(0, point, best);
    return best;
}

} // namespace millwright::exchange
