#include "core/exchange/internal/fit_deviation.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/exchange/internal/triangle_search.h"
#include "core/geometry/closest_point.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace millwright::exchange {

namespace {

using geometry::BezierPatch;

Deviation
deviation_of_points(const std::vector<Vec3>& points, const BezierPatch& patch, const Progress& progress) {
    const geometry::ClosestPointSearch search(patch);
    Deviation result;
    result.at_points.resize(points.size());
    parallel_for(std::ssize(points), 256, [&](std::ptrdiff_t n) {
        if (progress.cancelled()) {
            return;
        }
        const Vec3& point = points[static_cast<std::size_t>(n)];
        const geometry::ClosestPoint nearest = search.closest(point);
        const std::optional<Vec3> normal = patch.unit_normal(nearest.parameters.x(), nearest.parameters.y());
        const bool below = normal && normal->dot(point - nearest.position) < 0.0;
        result.at_points[static_cast<std::size_t>(n)] = below ? -nearest.distance : nearest.distance;
    });
    progress.check();
    double squares = 0.0;
    for (const double distance : result.at_points) {
        result.max = std::max(result.max, std::abs(distance));
        result.mean += std::abs(distance);
        squares += distance * distance;
    }
    const double count = static_cast<double>(points.size());
    result.mean /= count;
    result.rms = std::sqrt(squares / count);
    return result;
}

/// Whether each of the places lies inside the outline of the face.
std::vector<char> insides(const CadFace& face, const std::vector<Vec2>& places) {
    const geometry::Trim trim = face.trim();
    const Vec2 whole(face.rows, face.columns);
    std::vector<char> inside(places.size());
    parallel_for(std::ssize(places), 256, [&](std::ptrdiff_t n) {
        const auto at = static_cast<std::size_t>(n);
        inside[at] = trim.contains(places[at].cwiseQuotient(whole)) ? 1 : 0;
    });
    return inside;
}

/// Of points that are spread over the face, equally many on equal areas, and of the corners of its triangles,
/// which are on its sides, too: only what its outline leaves, unless that is too little to be met.
Deviation
deviation_from(const FitTarget& target, int points, const BezierPatch& patch, const Progress& progress) {
    const CadFace& face = *target.face;
    std::vector<Vec2> places;
    for (const Spread& spread : spread_over(target.side.mesh, target.side.area, points)) {
        places.push_back(spread.of(target.places));
    }
    const std::vector<char> spread_inside = insides(face, places);
    std::vector<Vec3> inside;
    for (std::size_t n = 0; n < places.size(); ++n) {
        if (spread_inside[n] != 0) {
            inside.push_back(face.position(places[n]));
        }
    }
    Deviation at_corners = deviation_of_points(target.side.mesh.points, patch, progress);
    if (inside.empty()) {
        return at_corners;
    }
    Deviation result = deviation_of_points(inside, patch, progress);
    const std::vector<char> corner_inside = insides(face, target.places);
    for (std::size_t n = 0; n < corner_inside.size(); ++n) {
        result.max =
            corner_inside[n] != 0 ? std::max(result.max, std::abs(at_corners.at_points[n])) : result.max;
    }
    result.at_points = std::move(at_corners.at_points);
    return result;
}

// ---- the way back

/// A point of the patch: how far it is from what was fitted, and whether the patch looks the wrong way there.
struct PatchPoint {
    double distance = 0.0;
    double area = 0.0; ///< |S_u x S_v|
    bool reversed = false;
};

/// The part of the patch that looks the wrong way, and the place where it is largest.
struct Fold {
    double area = 0.0;
    double largest = 0.0;
    Vec2 at = Vec2::Zero();

    void add(const PatchPoint& point, const Vec2& uv) {
        area += point.area;
        if (point.area > largest) {
            largest = point.area;
            at = uv;
        }
    }
};

/// From a point of the patch to the triangles, or to the face itself near the nearest of them.
class WayBack {
public:
    WayBack(const FitTarget& target, const BezierPatch& patch, const std::optional<Vec3>& along)
        : target_(target), patch_(patch), along_(along), triangles_(target.side.mesh) {}

    [[nodiscard]] PatchPoint from(const Vec2& uv) const {
        const auto at = patch_.derivatives(uv.x(), uv.y());
        const NearestTriangle nearest = triangles_.nearest(at.position);
        PatchPoint point{nearest.distance, at.du.cross(at.dv).norm(), false};
        std::optional<Vec3> outwards = along_;
        if (target_.face != nullptr) {
            const Spread spread{target_.side.mesh.triangles[nearest.triangle], nearest.shares};
            const auto [distance, normal] = to_face(at.position, spread.of(target_.places));
            point.distance = distance;
            outwards = along_ ? along_ : normal;
        }
        constexpr double backwards = -0.1; // cosine: more than rounding at a side that is seen edge on
        const std::optional<Vec3> normal = patch_.unit_normal(at);
        point.reversed = normal && outwards && normal->dot(*outwards) < backwards;
        return point;
    }

private:
    const FitTarget& target_;
    const BezierPatch& patch_;
    const std::optional<Vec3>& along_;
    TriangleSearch triangles_;

    [[nodiscard]] std::pair<double, std::optional<Vec3>> to_face(const Vec3& point, const Vec2& place) const {
        const CadFace& face = *target_.face;
        const int row = std::clamp(static_cast<int>(place.x()), 0, face.rows - 1);
        const int column = std::clamp(static_cast<int>(place.y()), 0, face.columns - 1);
        const BezierPatch& part = face.patches[static_cast<std::size_t>(row * face.columns + column)];
        const geometry::ClosestPoint found =
            geometry::closest_point_near(part, point, Vec2(place.x() - row, place.y() - column));
        return {found.distance, part.unit_normal(found.parameters.x(), found.parameters.y())};
    }
};

/// Of a raster over the patch, as far as `trim` leaves it.
void measure_patch(Deviation& deviation,
                   const WayBack& way,
                   const geometry::Trim& trim,
                   const Progress& progress) {
    constexpr int steps = 128; // both ways
    constexpr int side = steps + 1;
    const auto uv_of = [](std::ptrdiff_t n) {
        return Vec2(static_cast<double>(n / side) / steps, static_cast<double>(n % side) / steps);
    };
    std::vector<std::optional<PatchPoint>> points(std::size_t{side} * side);
    parallel_for(std::ssize(points), 256, [&](std::ptrdiff_t n) {
        if (!progress.cancelled() && trim.contains(uv_of(n))) {
            points[static_cast<std::size_t>(n)] = way.from(uv_of(n));
        }
    });
    progress.check();
    double sum = 0.0;
    double area = 0.0;
    int count = 0;
    Fold fold;
    for (std::size_t n = 0; n < points.size(); ++n) {
        if (!points[n]) {
            continue;
        }
        const Vec2 uv = uv_of(static_cast<std::ptrdiff_t>(n));
        area += points[n]->area;
        if (points[n]->reversed) {
            fold.add(*points[n], uv);
        }
        sum += points[n]->distance;
        ++count;
        if (points[n]->distance > deviation.patch_max) {
            deviation.patch_max = points[n]->distance;
            deviation.patch_max_at = uv;
        }
    }
    constexpr double hardly_any = 1e-4; // of the area: at a corner whose sides are nearly in line
    if (fold.area > hardly_any * area) {
        throw Error(fmt::format("the fitted patch folds over itself near u {:.2f}, v {:.2f}",
                                fold.at.x(),
                                fold.at.y()),
                    {},
                    "take another degree, or the side that is seen from another direction");
    }
    deviation.patch_mean = sum / std::max(count, 1);
}

/// A patch that goes away from what is fitted bulges where no point holds it. One that fills a rectangle may
/// go beyond, as far as across a quarter of the rectangle that is empty.
void refuse_leaving(const Deviation& deviation, const FitTarget& target, bool follows_outline) {
    const double far_off = follows_outline ? 0.03 : 0.5; // of the diagonal
    constexpr double times_as_far = 2.0;
    Box3 box;
    for (const Vec3& point : target.side.mesh.points) {
        box.extend(point);
    }
    const double most = std::max(far_off * box.diagonal().norm(), times_as_far * deviation.max);
    if (deviation.patch_max > most) {
        throw Error(
            fmt::format("the fitted patch leaves the {}: near u {:.2f}, v {:.2f} it is {:.3g} mm away, "
                        "though no point of the {} is farther than {:.3g} mm from the patch",
                        target.face != nullptr ? "face" : "mesh",
                        deviation.patch_max_at.x(),
                        deviation.patch_max_at.y(),
                        deviation.patch_max,
                        target.face != nullptr ? "face" : "mesh",
                        deviation.max),
            {},
            "take a lower degree");
    }
}

} // namespace

Deviation deviation_of_fit(const FitTarget& target,
                           const BezierPatch& patch,
                           const geometry::Trim& trim,
                           const std::optional<Vec3>& along,
                           bool follows_outline,
                           int points,
                           const Progress& progress) {
    Deviation deviation = target.face != nullptr
                              ? deviation_from(target, points, patch, progress)
                              : deviation_of_points(target.side.mesh.points, patch, progress);
    measure_patch(deviation, WayBack(target, patch, along), trim, progress);
    refuse_leaving(deviation, target, follows_outline);
    return deviation;
}

} // namespace millwright::exchange
