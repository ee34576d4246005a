#include "core/region/internal/joined_surface.h"

#include "core/geometry/net_editing.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace millwright::region {

using geometry::SurfaceDerivatives;

namespace {

/// Which side of [0,1]^2 a place is beyond, the farther one first; along it, how far it has come.
struct Exit {
    int side = 0;
    double along = 0.0;
    double by = 0.0; ///< positive: beyond
};

std::array<Exit, 4> exits(const Vec2& uv) {
    std::array<Exit, 4> all{{{0, uv.x(), -uv.y()},
                             {1, uv.y(), uv.x() - 1.0},
                             {2, 1.0 - uv.x(), uv.y() - 1.0},
                             {3, 1.0 - uv.y(), -uv.x()}}};
    std::ranges::stable_sort(all, [](const Exit& a, const Exit& b) { return a.by > b.by; });
    return all;
}

/// Of half the squared distance, by the parameters.
Eigen::Matrix2d hessian(const SurfaceDerivatives& at, const Vec3& off) {
    Eigen::Matrix2d h;
    h(0, 0) = at.du.squaredNorm() - off.dot(at.duu);
    h(0, 1) = h(1, 0) = at.du.dot(at.dv) - off.dot(at.duv);
    h(1, 1) = at.dv.squaredNorm() - off.dot(at.dvv);
    return h;
}

/// Without its curvature where that makes no minimum.
Eigen::Matrix2d usable(const SurfaceDerivatives& at, const Vec3& off) {
    const Eigen::Matrix2d h = hessian(at, off);
    constexpr double least = 1e-12; // of the product of the diagonal
    return h(0, 0) > 0.0 && h.determinant() > least * h(0, 0) * h(1, 1) ? h : hessian(at, Vec3::Zero());
}

} // namespace

FaceNeighbours::FaceNeighbours(std::size_t faces, const FaceMesh& mesh) : links_(4 * faces) {
    for (const FaceBorder& border : mesh.borders) {
        for (std::size_t k = 0; k < 2 && border.sides.size() == 2; ++k) {
            const FaceBorder::Side& own = border.sides[k];
            const FaceBorder::Side& other = border.sides[1 - k];
            Link link{own.along, other.face, other.side, other.along};
            if (own.along.front() > own.along.back()) {
                std::ranges::reverse(link.along);
                std::ranges::reverse(link.there);
            }
            links_[static_cast<std::size_t>(4 * own.face + own.side)].push_back(std::move(link));
        }
    }
}

std::optional<OnFace> FaceNeighbours::across(int face, int side, double along) const {
    const double at = std::clamp(along, 0.0, 1.0);
    for (const Link& link : links_[static_cast<std::size_t>(4 * face + side)]) {
        if (at < link.along.front() || at > link.along.back()) {
            continue;
        }
        const auto above = std::upper_bound(link.along.begin() + 1, link.along.end() - 1, at);
        const auto n = static_cast<std::size_t>(above - link.along.begin());
        const double share = (at - link.along[n - 1]) / (link.along[n] - link.along[n - 1]);
        const double there = link.there[n - 1] + share * (link.there[n] - link.there[n - 1]);
        return OnFace{link.face, place_on_side(link.side, there)};
    }
    return std::nullopt;
}

struct JoinedSurface::Foot {
    OnFace on;
    SurfaceDerivatives at;
};

JoinedSurface::JoinedSurface(std::vector<geometry::BsplineSurface> faces,
                             geometry::BsplineSurface map,
                             std::shared_ptr<const PlaceLookup> lookup,
                             std::shared_ptr<const FaceNeighbours> neighbours)
    : faces_(std::move(faces)), map_(std::move(map)), lookup_(std::move(lookup)),
      neighbours_(std::move(neighbours)) {
    for (const geometry::BsplineSurface& face : faces_) {
        box_.extend(face.control_box());
        smallest_tangent_ = std::max(smallest_tangent_, face.smallest_tangent());
    }
}

/// Newton on the face and its continuation, no farther than a tenth beyond its sides. A step of 1e-12 leaves
/// its square.
JoinedSurface::Foot JoinedSurface::foot_on(int face, Vec2 uv, const Vec3& point) const {
    const geometry::BsplineSurface& surface = faces_[static_cast<std::size_t>(face)];
    constexpr int most_steps = 20;
    constexpr double beyond = 0.1, longest = 0.25, smallest = 1e-12;
    for (int n = 0; n < most_steps; ++n) {
        const SurfaceDerivatives at = surface.derivatives(uv.x(), uv.y());
        const Vec3 off = point - at.position;
        const Vec2 slope(off.dot(at.du), off.dot(at.dv));
        Vec2 step = usable(at, off).inverse() * slope;
        if (!step.allFinite()) {
            break;
        }
        const double length = step.cwiseAbs().maxCoeff();
        step *= std::min(1.0, longest / std::max(length, smallest));
        const Vec2 next = (uv + step).cwiseMax(-beyond).cwiseMin(1.0 + beyond);
        const double moved = (next - uv).cwiseAbs().maxCoeff();
        uv = next;
        if (moved < smallest) {
            break;
        }
    }
    return {{face, uv}, surface.derivatives(uv.x(), uv.y())};
}

/// From face to face, until it stays on one. Where it would go back, or over the boundary, it stays, too: the
/// faces go on beyond their sides as far as the map is off.
JoinedSurface::Foot JoinedSurface::foot(const Vec2& place, const Vec3& point) const {
    const OnFace seed = lookup_->at(place);
    Foot now = foot_on(seed.face, seed.uv, point);
    std::vector<int> seen{seed.face};
    bool moves = true;
    while (moves) {
        moves = false;
        for (const Exit& exit : exits(now.on.uv)) {
            if (!(exit.by > 0.0)) {
                break;
            }
            const auto next = neighbours_->across(now.on.face, exit.side, exit.along);
            if (next && std::ranges::find(seen, next->face) == seen.end()) {
                now = foot_on(next->face, next->uv, point);
                seen.push_back(next->face);
                moves = true;
                break;
            }
        }
    }
    return now;
}

namespace {

/// How face and map go on along one parameter of the square.
struct Course {
    Vec2 w;    ///< of the face's parameters
    Vec3 slip; ///< by which the map goes faster than the surface
};

} // namespace

/// From (Q - S) . S_u = 0 and (Q - S) . S_v = 0, derived by the place; without what the third derivatives of
/// the face add, which vanish with the distance of the map from the face.
SurfaceDerivatives JoinedSurface::derivatives(double u, double v) const {
    const SurfaceDerivatives Q = map_.derivatives(u, v);
    const SurfaceDerivatives S = foot({u, v}, Q.position).at;
    const Eigen::Matrix2d H = usable(S, Q.position - S.position);
    const Eigen::Matrix2d inverse = H.inverse();
    if (!inverse.allFinite()) { // a side of the face that is one point
        return {S.position, Q.du, Q.dv, Q.duu, Q.duv, Q.dvv};
    }
    const auto tangent = [&](const Vec2& w) -> Vec3 { return w.x() * S.du + w.y() * S.dv; };
    const auto course = [&](const Vec3& q) -> Course {
        const Vec2 w = inverse * Vec2(q.dot(S.du), q.dot(S.dv));
        return {w, q - tangent(w)};
    };
    const auto second = [&](const Vec3& q, const Course& a, const Course& b) -> Vec3 {
        const Vec3 bend = a.w.x() * b.w.x() * S.duu + (a.w.x() * b.w.y() + a.w.y() * b.w.x()) * S.duv +
                          a.w.y() * b.w.y() * S.dvv;
        const auto row = [&](const Vec3& along, const Vec3& by_u, const Vec3& by_v) {
            return (q - bend).dot(along) + a.slip.dot(b.w.x() * by_u + b.w.y() * by_v) +
                   b.slip.dot(a.w.x() * by_u + a.w.y() * by_v);
        };
        const Vec2 w = inverse * Vec2(row(S.du, S.duu, S.duv), row(S.dv, S.duv, S.dvv));
        return tangent(w) + bend;
    };
    const Course s = course(Q.du), t = course(Q.dv);
    return {S.position,
            tangent(s.w),
            tangent(t.w),
            second(Q.duu, s, s),
            second(Q.duv, s, t),
            second(Q.dvv, t, t)};
}

geometry::SurfacePoint JoinedSurface::point(double u, double v) const {
    const SurfaceDerivatives at = derivatives(u, v);
    return {at.position, unit_normal(at)};
}

std::vector<geometry::SurfacePiece> JoinedSurface::pieces() const {
    std::vector<geometry::SurfacePiece> all;
    for (int face = 0; face < std::ssize(faces_); ++face) {
        for (geometry::SurfacePiece& piece : faces_[static_cast<std::size_t>(face)].pieces()) {
            const Eigen::AlignedBox2d places = lookup_->places_of(face, piece.low, piece.high);
            if (!places.isEmpty()) {
                piece.low = places.min();
                piece.high = places.max();
                all.push_back(std::move(piece));
            }
        }
    }
    return all;
}

std::shared_ptr<const geometry::ParametricSurface> JoinedSurface::shared() const {
    return std::make_shared<const JoinedSurface>(*this);
}

OnFace JoinedSurface::on_face(const Vec2& place) const {
    return foot(place, map_.position(place.x(), place.y())).on;
}

std::optional<double> JoinedSurface::off_boundary(const Vec2& place) const {
    const OnFace on = on_face(place);
    const geometry::BsplineSurface& face = faces_[static_cast<std::size_t>(on.face)];
    const Vec3 here = face.position(on.uv.x(), on.uv.y());
    std::optional<double> least;
    for (const Exit& exit : exits(on.uv)) {
        if (!neighbours_->across(on.face, exit.side, exit.along)) {
            const Vec2 uv = place_on_side(exit.side, std::clamp(exit.along, 0.0, 1.0));
            const double off = (face.position(uv.x(), uv.y()) - here).norm();
            least = std::min(least.value_or(off), off);
        }
    }
    return least;
}

JoinedSurface JoinedSurface::turned(double turn) const {
    std::vector<geometry::BsplineSurface> faces;
    for (const geometry::BsplineSurface& face : faces_) {
        faces.emplace_back(geometry::turned(face.net(), turn));
    }
    return {
        std::move(faces), geometry::BsplineSurface(geometry::turned(map_.net(), turn)), lookup_, neighbours_};
}

} // namespace millwright::region
