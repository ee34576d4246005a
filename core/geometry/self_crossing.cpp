#include "core/geometry/self_crossing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace millwright::geometry {

namespace {

constexpr double coincident = 1e-9; // of the size of the patch
constexpr double least_mm = 1e-9;

struct Corner {
    int i = 0, j = 0;
    Vec3 at = Vec3::Zero();
};

struct Triangle {
    std::array<Corner, 3> corners;
    Box3 box;
};

/// Whether the way from `a` to `b` goes through the inside of the triangle (Moeller and Trumbore 1997).
bool pierces(const Vec3& a, const Vec3& b, const Triangle& of) {
    constexpr double inside = 1e-9;
    const Vec3 way = b - a;
    const Vec3 e1 = of.corners[1].at - of.corners[0].at;
    const Vec3 e2 = of.corners[2].at - of.corners[0].at;
    const Vec3 p = way.cross(e2);
    const double volume = e1.dot(p);
    if (!(std::abs(volume) > inside * way.norm() * e1.norm() * e2.norm())) {
        return false; // along it, or one of them has no size
    }
    const Vec3 from = a - of.corners[0].at;
    const double s = from.dot(p) / volume;
    const Vec3 q = from.cross(e1);
    const double t = way.dot(q) / volume;
    const double along = e2.dot(q) / volume;
    return s > inside && t > inside && s + t < 1.0 - inside && along > inside && along < 1.0 - inside;
}

bool triangles_cross(const Triangle& a, const Triangle& b) {
    for (std::size_t n = 0; n < 3; ++n) {
        const std::size_t next = (n + 1) % 3;
        if (pierces(a.corners[n].at, a.corners[next].at, b) ||
            pierces(b.corners[n].at, b.corners[next].at, a)) {
            return true;
        }
    }
    return false;
}

class PatchMesh {
public:
    PatchMesh(const ParametricSurface& patch, int cells) : cells_(cells) {
        std::vector<Corner> corners;
        for (int i = 0; i <= cells; ++i) {
            for (int j = 0; j <= cells; ++j) {
                corners.push_back({i, j, patch.position(parameter(i), parameter(j))});
            }
        }
        const auto corner = [&](int i, int j) {
            return corners[static_cast<std::size_t>(i * (cells + 1) + j)];
        };
        for (int i = 0; i < cells; ++i) {
            for (int j = 0; j < cells; ++j) {
                add({corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)});
                add({corner(i, j), corner(i + 1, j + 1), corner(i, j + 1)});
            }
        }
        near_ = std::max(least_mm, coincident * patch.control_box().diagonal().norm());
    }

    /// The first pair that meets.
    [[nodiscard]] std::optional<SelfCrossing> crossing() const {
        for (std::size_t a = 0; a < triangles_.size(); ++a) {
            for (std::size_t b = a + 1; b < triangles_.size(); ++b) {
                if (triangles_[a].box.intersects(triangles_[b].box) && meet(triangles_[a], triangles_[b])) {
                    return SelfCrossing{middle(triangles_[a]), middle(triangles_[b])};
                }
            }
        }
        return std::nullopt;
    }

private:
    [[nodiscard]] double parameter(int n) const { return static_cast<double>(n) / cells_; }
    [[nodiscard]] bool inside(const Corner& corner) const {
        return corner.i > 0 && corner.i < cells_ && corner.j > 0 && corner.j < cells_;
    }

    [[nodiscard]] bool is_flat(const Triangle& of) const {
        const Vec3 e1 = of.corners[1].at - of.corners[0].at;
        const Vec3 e2 = of.corners[2].at - of.corners[0].at;
        return !(e1.cross(e2).norm() > near_ * std::max(e1.norm(), e2.norm()));
    }

    void add(const std::array<Corner, 3>& corners) {
        Triangle triangle{corners, {}};
        for (const Corner& corner : corners) {
            triangle.box.extend(corner.at);
        }
        triangles_.push_back(triangle);
    }

    /// Neighbours share a corner, at a side also with a triangle that is far off in the parameters.
    [[nodiscard]] bool meet(const Triangle& a, const Triangle& b) const {
        if (is_flat(a) || is_flat(b)) {
            return false; // where a patch shrinks to a line or a point it has no normal, which is reported
                          // as such
        }
        bool neighbours = false;
        for (const Corner& p : a.corners) {
            for (const Corner& q : b.corners) {
                if ((p.at - q.at).squaredNorm() > near_ * near_) {
                    continue;
                }
                const bool same_place = std::abs(p.i - q.i) <= 1 && std::abs(p.j - q.j) <= 1;
                if (!same_place && (inside(p) || inside(q))) {
                    return true;
                }
                neighbours = true;
            }
        }
        return !neighbours && triangles_cross(a, b);
    }

    [[nodiscard]] Vec2 middle(const Triangle& of) const {
        Vec2 sum = Vec2::Zero();
        for (const Corner& corner : of.corners) {
            sum += Vec2(parameter(corner.i), parameter(corner.j));
        }
        return sum / 3.0;
    }

    int cells_;
    double near_ = 0.0;
    std::vector<Triangle> triangles_;
};

} // namespace

std::optional<SelfCrossing> self_crossing(const ParametricSurface& patch, int cells) {
    return PatchMesh(patch, cells).crossing();
}

} // namespace millwright::geometry
