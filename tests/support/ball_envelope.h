// What a ball leaves over a surface, by brute force: spheres along its path, near to each other, and the rays
// from the surface that meet them. Shares nothing with the code under test but the surface.
#pragma once

#include "core/geometry/bezier_patch.h"
#include "core/toolpath/toolpath.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace millwright::test {

class BallEnvelope {
public:
    /// The ball touches the surface at `path`'s contacts and at what lies straight between their parameters;
    /// it stands on the side of S_u x S_v. Two spheres are `apart` at most.
    BallEnvelope(const geometry::BezierPatch& patch,
                 double radius,
                 const toolpath::Toolpath& path,
                 double apart)
        : patch_(patch), radius_(radius) {
        for (std::size_t n = 1; n < path.points.size(); ++n) {
            const toolpath::PathPoint& to = path.points[n];
            if (to.reached_by == toolpath::MoveKind::track) {
                add(path.points[n - 1].origin.uv, to.origin.uv, apart);
            }
        }
    }

    /// Along the normal over a point of the surface; infinity where no ball comes.
    [[nodiscard]] double left_over(const Vec2& uv) const {
        const Vec3 point = patch_.position(uv.x(), uv.y());
        const Vec3 normal = patch_.unit_normal(uv.x(), uv.y()).value();
        double left = std::numeric_limits<double>::infinity();
        const auto [x, y] = cell_of(point);
        for (int i = x - 1; i <= x + 1; ++i) {
            for (int j = y - 1; j <= y + 1; ++j) {
                const auto found = cells_.find({i, j});
                if (found != cells_.end()) {
                    left = std::min(left, lowest(found->second, point, normal));
                }
            }
        }
        return left;
    }

    struct Figures {
        double max = 0.0;
        double mean = 0.0;
    };
    [[nodiscard]] Figures figures(int nu, int nv) const {
        Figures found;
        for (int i = 0; i < nu; ++i) {
            for (int j = 0; j < nv; ++j) {
                const double left =
                    left_over({static_cast<double>(i) / (nu - 1), static_cast<double>(j) / (nv - 1)});
                found.max = std::max(found.max, left);
                found.mean += std::max(left, 0.0) / (static_cast<double>(nu) * nv);
            }
        }
        return found;
    }

private:
    using Cell = std::pair<int, int>;

    [[nodiscard]] Cell cell_of(const Vec3& at) const { // by the contacts, a radius wide
        return {static_cast<int>(std::floor(at.x() / radius_)),
                static_cast<int>(std::floor(at.y() / radius_))};
    }

    void add(const Vec2& from, const Vec2& to, double apart) {
        constexpr int coarse = 16;
        double length = 0.0;
        for (int k = 0; k < coarse; ++k) {
            const Vec2 a = from + (to - from) * k / coarse;
            const Vec2 b = from + (to - from) * (k + 1) / coarse;
            length += (patch_.position(b.x(), b.y()) - patch_.position(a.x(), a.y())).norm();
        }
        const int count = std::max(1, static_cast<int>(std::ceil(1.5 * length / apart)));
        for (int k = 0; k <= count; ++k) {
            const Vec2 uv = from + (to - from) * k / count;
            const Vec3 contact = patch_.position(uv.x(), uv.y());
            cells_[cell_of(contact)].push_back(contact +
                                               radius_ * patch_.unit_normal(uv.x(), uv.y()).value());
        }
    }

    [[nodiscard]] double
    lowest(const std::vector<Vec3>& centres, const Vec3& point, const Vec3& normal) const {
        double left = std::numeric_limits<double>::infinity();
        for (const Vec3& centre : centres) {
            const double rise = (centre - point).dot(normal);
            const double square_off = (centre - point).squaredNorm() - rise * rise;
            if (square_off < radius_ * radius_) {
                left = std::min(left, rise - std::sqrt(radius_ * radius_ - square_off));
            }
        }
        return left;
    }

    const geometry::BezierPatch& patch_;
    double radius_;
    std::map<Cell, std::vector<Vec3>> cells_;
};

} // namespace millwright::test
