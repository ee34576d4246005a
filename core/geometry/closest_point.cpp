#include "core/geometry/closest_point.h"

#include "core/base/error.h"
#include "core/geometry/bezier_patch.h"
#include "core/geometry/internal/surface_cells.h"

#include <nanoflann.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace millwright::geometry {

namespace {

Vec2 clamped(const Vec2& uv) {
    return uv.cwiseMax(0.0).cwiseMin(1.0);
}

/// Gradient and Hessian of f = |S - p|^2 / 2 at one parameter.
struct Quadratic {
    Vec3 position = Vec3::Zero(); ///< S
    double f = 0.0;
    Vec2 gradient = Vec2::Zero();
    Eigen::Matrix2d hessian = Eigen::Matrix2d::Zero();
    Eigen::Matrix2d gauss_newton = Eigen::Matrix2d::Zero();
};

Quadratic quadratic_at(const ParametricSurface& patch, const Vec3& p, const Vec2& uv) {
    const SurfaceDerivatives at = patch.derivatives(uv.x(), uv.y());
    const Vec3 r = at.position - p;
    Quadratic q;
    q.position = at.position;
    q.f = 0.5 * r.squaredNorm();
    q.gradient = {r.dot(at.du), r.dot(at.dv)};
    const double uu = at.du.squaredNorm();
    const double uv_ = at.du.dot(at.dv);
    const double vv = at.dv.squaredNorm();
    q.gauss_newton << uu, uv_, uv_, vv;
    q.hessian << uu + r.dot(at.duu), uv_ + r.dot(at.duv), uv_ + r.dot(at.duv), vv + r.dot(at.dvv);
    return q;
}

/// Parameters held at a side of the square, because the descent would leave it there.
std::array<bool, 2> held(const Vec2& uv, const Vec2& gradient) {
    std::array<bool, 2> result{};
    for (int k = 0; k < 2; ++k) {
        result[static_cast<std::size_t>(k)] =
            (uv[k] <= 0.0 && gradient[k] > 0.0) || (uv[k] >= 1.0 && gradient[k] < 0.0);
    }
    return result;
}

/// The Newton step on the free parameters; Gauss-Newton where the Hessian is not positive definite.
Vec2 step(const Quadratic& q, const std::array<bool, 2>& fixed) {
    for (const Eigen::Matrix2d* matrix : {&q.hessian, &q.gauss_newton}) {
        Eigen::Matrix2d h = *matrix;
        Vec2 g = q.gradient;
        for (int k = 0; k < 2; ++k) {
            if (fixed[static_cast<std::size_t>(k)]) {
                h.row(k).setZero();
                h.col(k).setZero();
                h(k, k) = 1.0;
                g[k] = 0.0;
            }
        }
        const double det = h.determinant();
        if (h(0, 0) > 0.0 && h(1, 1) > 0.0 && det > 1e-12 * h(0, 0) * h(1, 1)) {
            return -(h.inverse() * g);
        }
    }
    const double scale = q.gauss_newton.trace();
    return scale > 0.0 ? Vec2(-q.gradient / scale) : Vec2(Vec2::Zero());
}

/// Whether the way to `point` is across the surface there, as far as it may leave the place.
bool is_minimum(const ParametricSurface& patch, const Vec3& point, const Vec2& uv) {
    constexpr double across = 1e-6;   // rad
    constexpr double touching = 1e-9; // mm
    const Quadratic q = quadratic_at(patch, point, uv);
    const double distance = (q.position - point).norm();
    const std::array<bool, 2> fixed = held(uv, q.gradient);
    for (int k = 0; k < 2; ++k) {
        const double tangent = std::sqrt(q.gauss_newton(k, k));
        if (!fixed[static_cast<std::size_t>(k)] &&
            !(std::abs(q.gradient[k]) <= across * tangent * distance)) {
            return distance < touching;
        }
    }
    return true;
}

/// Whether equal steps of the parameters may be steps of the surface that are far from equal.
bool has_uneven_weights(const BezierPatch& patch) {
    constexpr double even = 100.0; // greatest by least; within it 32 x 32 equal cells find all minima
    const auto [least, most] = std::ranges::minmax_element(patch.net().weights);
    return patch.rational() && *most > even * *least;
}

/// Of 3 x 3 places between `low` and `high` the nearest.
Vec2 best_start(const ParametricSurface& patch, const Vec2& low, const Vec2& high, const Vec3& point) {
    Vec2 best = low;
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            const Vec2 uv = low + Vec2(0.5 * i, 0.5 * j).cwiseProduct(high - low);
            const double squared = (patch.position(uv.x(), uv.y()) - point).squaredNorm();
            if (squared < least) {
                least = squared;
                best = uv;
            }
        }
    }
    return best;
}

} // namespace

ClosestPoint closest_point_near(const ParametricSurface& patch, const Vec3& point, const Vec2& start) {
    expects(is_finite(point) && is_finite(start), "the closest point is asked for a finite point");
    constexpr int most_steps = 50;
    constexpr double smallest_step = 1e-13; // of the parameter: about 1e-11 mm on a part of 100 mm
    Vec2 uv = clamped(start);
    Quadratic now = quadratic_at(patch, point, uv);
    for (int n = 0; n < most_steps; ++n) {
        const Vec2 full = step(now, held(uv, now.gradient));
        double fraction = 1.0;
        Vec2 next = clamped(uv + full);
        Quadratic there = quadratic_at(patch, point, next);
        while (there.f > now.f && fraction > 1e-4) {
            fraction *= 0.5;
            next = clamped(uv + fraction * full);
            there = quadratic_at(patch, point, next);
        }
        if (!(there.f <= now.f)) {
            break;
        }
        const double moved = (next - uv).cwiseAbs().maxCoeff();
        uv = next;
        now = there;
        if (moved < smallest_step) {
            break;
        }
    }
    return {uv, now.position, (now.position - point).norm()};
}

struct ClosestPointSearch::Samples {
    /// What a descent within a part came to.
    struct Descent {
        double distance = 0.0;
        bool converged = false;
        const BalancedCells::Part* part = nullptr;
    };

    static constexpr int side = 48;
    using Tree =
        nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Samples>, Samples, 3>;

    explicit Samples(const ParametricSurface& of) : Samples(of, of.pieces()) {}
    Samples(const ParametricSurface& of, const std::vector<SurfacePiece>& pieces)
        : surface(of.shared()), patch(*surface), cells(pieces) {
        if (pieces.size() == 1 && has_uneven_weights(pieces.front().patch)) {
            parts.emplace(pieces.front().patch);
        }
        for (int i = 0; i <= side; ++i) {
            for (int j = 0; j <= side; ++j) {
                const Vec2 uv(static_cast<double>(i) / side, static_cast<double>(j) / side);
                parameters.push_back(uv);
                points.push_back(patch.position(uv.x(), uv.y()));
            }
        }
        tree = std::make_unique<Tree>(3, *this);
        tree->buildIndex();
    }

    [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
    [[nodiscard]] double kdtree_get_pt(std::size_t n, std::size_t axis) const {
        return points[n][static_cast<Eigen::Index>(axis)];
    }
    template <class BoundingBox> bool kdtree_get_bbox(BoundingBox&) const { return false; }

    [[nodiscard]] Vec2 nearest(const Vec3& point) const {
        std::uint32_t found = 0;
        double squared = 0.0;
        tree->knnSearch(point.data(), 1, &found, &squared);
        return parameters[found];
    }

    /// `found`, or what lies nearer in another cell.
    [[nodiscard]] ClosestPoint nearest_of_all(const Vec3& point, ClosestPoint found) const {
        if (parts) {
            return nearest_of_parts(point, found);
        }
        cells.visit(
            point,
            [&] { return found.distance; },
            [&](const CellTree::Cell& cell) {
                const Vec2 half = 0.5 * (cell.high - cell.low);
                const Vec2 middle = cell.low + half;
                const Vec2 away = (found.parameters - middle).cwiseAbs() - half;
                if ((away.array() <= half.array()).all()) {
                    return; // its descent, or that of the cell beside it, has ended here
                }
                const ClosestPoint there =
                    closest_point_near(patch, point, best_start(patch, cell.low, cell.high, point));
                if (there.distance < found.distance) {
                    found = there;
                }
            });
        return found;
    }

    /// The same where the parameters tell little about places: each part is descended by its own.
    [[nodiscard]] ClosestPoint nearest_of_parts(const Vec3& point, ClosestPoint found) const {
        constexpr std::size_t most_halved = 4;
        std::vector<Descent> stuck; // the nearest first
        parts->visit(
            point,
            [&] { return found.distance; },
            [&](const BalancedCells::Part& part) {
                const Descent here = descend(part, point, found);
                if (!here.converged) {
                    stuck.insert(std::ranges::lower_bound(stuck, here.distance, {}, &Descent::distance),
                                 here);
                    stuck.resize(std::min(stuck.size(), most_halved));
                }
            });
        for (const Descent& one : stuck) {
            halve(*one.part, point, found);
        }
        return found;
    }

    /// How near `point` a descent within `part` comes; `found` becomes that where it is nearer.
    static Descent descend(const BalancedCells::Part& part, const Vec3& point, ClosestPoint& found) {
        const Vec2 start = best_start(part.patch, Vec2::Zero(), Vec2::Ones(), point);
        const ClosestPoint there = closest_point_near(part.patch, point, start);
        if (there.distance < found.distance) {
            found = {part.at(there.parameters), there.position, there.distance};
        }
        return {there.distance, is_minimum(part.patch, point, there.parameters), &part};
    }

    /// A descent may stick where the weights are uneven within a part, too: they are less so in its halves,
    /// of which the nearer one is halved again.
    static void halve(BalancedCells::Part part, const Vec3& point, ClosestPoint& found) {
        constexpr int most_halvings = 30;
        for (int n = 0; n < most_halvings; ++n) {
            if (!(part.patch.control_box().exteriorDistance(point) < found.distance)) {
                return;
            }
            auto [low, high] = BalancedCells::halves(part);
            const Descent by_low = descend(low, point, found);
            const Descent by_high = descend(high, point, found);
            const bool is_high = by_high.distance < by_low.distance;
            if (is_high ? by_high.converged : by_low.converged) {
                return;
            }
            part = is_high ? std::move(high) : std::move(low);
        }
    }

    std::shared_ptr<const ParametricSurface> surface;
    const ParametricSurface& patch;
    CellTree cells;
    std::optional<BalancedCells> parts; ///< with uneven weights
    std::vector<Vec3> points;
    std::vector<Vec2> parameters;
    std::unique_ptr<Tree> tree;
};

ClosestPointSearch::ClosestPointSearch(const ParametricSurface& surface)
    : samples_(std::make_unique<const Samples>(surface)) {}
ClosestPointSearch::~ClosestPointSearch() = default;
ClosestPointSearch::ClosestPointSearch(ClosestPointSearch&&) noexcept = default;
ClosestPointSearch& ClosestPointSearch::operator=(ClosestPointSearch&&) noexcept = default;

ClosestPoint ClosestPointSearch::closest(const Vec3& point) const {
    expects(is_finite(point), "the closest point is asked for a finite point");
    return samples_->nearest_of_all(point,
                                    closest_point_near(samples_->patch, point, samples_->nearest(point)));
}

ClosestPoint ClosestPointSearch::closest(const Vec3& point, const Vec2& guess) const {
    expects(is_finite(point), "the closest point is asked for a finite point");
    const ClosestPoint from_guess = closest_point_near(samples_->patch, point, guess);
    const Vec2 sample = samples_->nearest(point);
    constexpr double beside = 1.5 / Samples::side;
    const Vec3 at_sample = samples_->patch.position(sample.x(), sample.y());
    if ((sample - from_guess.parameters).cwiseAbs().maxCoeff() <= beside &&
        from_guess.distance <= (at_sample - point).norm()) {
        return samples_->nearest_of_all(point, from_guess);
    }
    const ClosestPoint from_samples = closest_point_near(samples_->patch, point, sample);
    return samples_->nearest_of_all(point,
                                    from_guess.distance <= from_samples.distance ? from_guess : from_samples);
}

} // namespace millwright::geometry
