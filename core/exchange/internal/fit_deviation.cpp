#include "core/exchange/internal/fit_deviation.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/geometry/closest_point.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace millwright::exchange {

std::vector<Spread> spread_over(const TriangleMesh& mesh, double area, int count) {
    constexpr double plastic = 1.32471795724474602596;
    const double step = area / count;
    std::vector<Spread> samples;
    samples.reserve(static_cast<std::size_t>(count));
    double passed = 0.0;
    for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
        passed += 0.5 * mesh.doubled_area(n).norm();
        while ((static_cast<double>(samples.size()) + 0.5) * step < passed && std::ssize(samples) < count) {
            const double k = static_cast<double>(samples.size()) + 1.0;
            double whole = 0.0;
            double s = std::modf(0.5 + k / plastic, &whole);
            double t = std::modf(0.5 + k / (plastic * plastic), &whole);
            if (s + t > 1.0) {
                s = 1.0 - s;
                t = 1.0 - t;
            }
            samples.push_back({mesh.triangles[n], {1.0 - s - t, s, t}});
        }
    }
    return samples;
}

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

namespace {

// ---- from the target to the patch

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

/// Inside the outline of the face; of all corners of its triangles if no point is inside.
Deviation
deviation_of_face(const FitTarget& target, int points, const BezierPatch& patch, const Progress& progress) {
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

// ---- from the patch to the target

/// Equally spaced points over a box of the parameters, its sides included.
class PatchRaster {
public:
    explicit PatchRaster(const Eigen::AlignedBox2d& box) : box_(box) {}

    [[nodiscard]] std::ptrdiff_t size() const { return std::ptrdiff_t{side} * side; }
    [[nodiscard]] Vec2 operator[](std::ptrdiff_t n) const {
        const Vec2 share(static_cast<double>(n / side) / steps, static_cast<double>(n % side) / steps);
        return box_.min() + box_.sizes().cwiseProduct(share);
    }

private:
    static constexpr int steps = 128;
    static constexpr int side = steps + 1;

    Eigen::AlignedBox2d box_;
};

Eigen::AlignedBox2d box_of(const geometry::Trim& trim) {
    if (trim.everything()) {
        return {Vec2(0.0, 0.0), Vec2(1.0, 1.0)};
    }
    Eigen::AlignedBox2d box;
    for (const geometry::Trim::Loop& loop : trim.loops) {
        for (const Vec2& corner : loop) {
            box.extend(corner);
        }
    }
    return box;
}

/// Adds up the samples of a patch that face backwards.
class FoldSum {
public:
    void add(const Vec2& uv, double area, bool reversed) {
        whole_ += area;
        if (!reversed) {
            return;
        }
        folded_ += area;
        if (area > largest_) {
            largest_ = area;
            at_ = uv;
        }
    }
    [[nodiscard]] Fold fold() const { return {whole_ > 0.0 ? folded_ / whole_ : 0.0, at_}; }

private:
    double whole_ = 0.0;
    double folded_ = 0.0;
    double largest_ = 0.0;
    Vec2 at_ = Vec2::Zero();
};

void refuse_fold(const Fold& fold, int outline_corners) {
    constexpr double negligible = 1e-4; // of the area: a corner whose sides are nearly in line turns over
    constexpr int of_patch = 4;
    if (fold.share > negligible && outline_corners > of_patch) {
        throw Error(
            fmt::format("the outline of the mesh has {} corners and a patch has four: following it, "
                        "the patch turns over on {:.2g} % of its area, mostly near u {:.2f}, v {:.2f}",
                        outline_corners,
                        100.0 * fold.share,
                        fold.at.x(),
                        fold.at.y()),
            {},
            "cut the mesh into parts with four sides and import one at a time");
    }
    if (fold.share > negligible) {
        throw Error(fmt::format("the fitted patch folds over itself: {:.2g} % of its area faces backwards, "
                                "mainly near u {:.2f}, v {:.2f}",
                                100.0 * fold.share,
                                fold.at.x(),
                                fold.at.y()),
                    {},
                    "choose another degree, or view the side from another direction");
    }
}

/// A patch bulges where no point holds it. One that fills a rectangle may extend beyond its target, for a
/// quarter of the rectangle can be empty.
void refuse_leaving(const Deviation& deviation, const FitTarget& target, bool follows_outline) {
    const double far_off = follows_outline ? 0.03 : 0.5; // of the diagonal
    constexpr double times_as_far = 2.0;
    Box3 box;
    for (const Vec3& point : target.side.mesh.points) {
        box.extend(point);
    }
    const double most = std::max(far_off * box.diagonal().norm(), times_as_far * deviation.max);
    if (deviation.patch_max > most) {
        const char* name = target.face != nullptr ? "face" : "mesh";
        throw Error(
            fmt::format("the fitted patch deviates from the {0}: near u {1:.2f}, v {2:.2f} it is {3:.3g} mm "
                        "away, but no point of the {0} is farther than {4:.3g} mm from the patch",
                        name,
                        deviation.patch_max_at.x(),
                        deviation.patch_max_at.y(),
                        deviation.patch_max,
                        deviation.max),
            {},
            "choose a lower degree");
    }
}

/// The patch of a face at a place in [0, rows] x [0, columns], and the parameters of the place on it.
std::pair<const BezierPatch&, Vec2> part_at(const CadFace& face, const Vec2& place) {
    const int row = std::clamp(static_cast<int>(place.x()), 0, face.rows - 1);
    const int column = std::clamp(static_cast<int>(place.y()), 0, face.columns - 1);
    return {face.patches[static_cast<std::size_t>(row * face.columns + column)],
            Vec2(place.x() - row, place.y() - column)};
}

} // namespace

FitComparison::FitComparison(const FitTarget& target, const std::optional<Vec3>& along)
    : target_(&target), along_(along), triangles_(target.side.mesh) {
    expects(target.face != nullptr || along_, "a mesh is seen from a direction");
}

/// `exactly`: the distance from the face itself, not from its triangles.
FitComparison::PatchPoint
FitComparison::compared(const BezierPatch& patch, const Vec2& uv, bool exactly) const {
    constexpr double backwards = -0.1; // cosine: more than rounding where the target is nearly edge on
    const auto at = patch.derivatives(uv.x(), uv.y());
    const NearestTriangle nearest = triangles_.nearest(at.position);
    PatchPoint point{nearest.distance, at.du.cross(at.dv).norm(), false};
    if (exactly && target_->face != nullptr) {
        const Spread spread{target_->side.mesh.triangles[nearest.triangle], nearest.shares};
        const auto [part, start] = part_at(*target_->face, spread.of(target_->places));
        point.distance = geometry::closest_point_near(part, at.position, start).distance;
    }
    if (const std::optional<Vec3> normal = patch.unit_normal(at)) {
        const Vec3 of_target = target_->side.mesh.doubled_area(nearest.triangle);
        const bool against_nearest = normal->dot(of_target) < backwards * of_target.norm();
        point.reversed = against_nearest && faces_away(*normal, uv);
    }
    return point;
}

/// The nearest triangle alone may mislead: a patch that rises beyond a steep rim still faces the viewer, and
/// the nearest point of a thin blade may lie on its other side.
bool FitComparison::faces_away(const Vec3& normal, const Vec2& uv) const {
    if (along_) {
        return normal.dot(*along_) < 0.0;
    }
    const CadFace& face = *target_->face;
    const auto [part, at] = part_at(face, uv.cwiseProduct(Vec2(face.rows, face.columns)));
    const std::optional<Vec3> of_face = part.unit_normal(at.x(), at.y());
    return !of_face || normal.dot(*of_face) < 0.0;
}

Fold FitComparison::fold_of(const BezierPatch& patch, const Progress& progress) const {
    const PatchRaster raster(box_of({}));
    std::vector<PatchPoint> points(static_cast<std::size_t>(raster.size()));
    parallel_for(raster.size(), 256, [&](std::ptrdiff_t n) {
        if (!progress.cancelled()) {
            points[static_cast<std::size_t>(n)] = compared(patch, raster[n], false);
        }
    });
    progress.check();
    FoldSum sum;
    for (std::size_t n = 0; n < points.size(); ++n) {
        sum.add(raster[static_cast<std::ptrdiff_t>(n)], points[n].area, points[n].reversed);
    }
    return sum.fold();
}

/// A mean over the area, from the points of the raster; the corners of the trim count for the largest only.
void FitComparison::measure_patch(Deviation& deviation,
                                  const BezierPatch& patch,
                                  const geometry::Trim& trim,
                                  const Progress& progress) const {
    const PatchRaster raster(box_of(trim));
    std::vector<Vec2> places;
    for (std::ptrdiff_t n = 0; n < raster.size(); ++n) {
        places.push_back(raster[n]);
    }
    for (const geometry::Trim::Loop& loop : trim.loops) {
        places.insert(places.end(), loop.begin(), loop.end());
    }
    std::vector<std::optional<PatchPoint>> points(places.size());
    parallel_for(std::ssize(places), 256, [&](std::ptrdiff_t n) {
        const auto at = static_cast<std::size_t>(n);
        if (!progress.cancelled() && (n >= raster.size() || trim.contains(places[at]))) {
            points[at] = compared(patch, places[at], true);
        }
    });
    progress.check();
    double sum = 0.0;
    double area = 0.0;
    FoldSum fold;
    for (std::size_t n = 0; n < points.size(); ++n) {
        if (!points[n]) {
            continue;
        }
        const PatchPoint& point = *points[n];
        if (point.distance > deviation.patch_max) {
            deviation.patch_max = point.distance;
            deviation.patch_max_at = places[n];
        }
        if (std::cmp_less(n, raster.size())) {
            sum += point.area * point.distance;
            area += point.area;
            fold.add(places[n], point.area, point.reversed);
        }
    }
    deviation.patch_mean = area > 0.0 ? sum / area : deviation.patch_max;
    refuse_fold(fold.fold(), target_->outlines.corners);
}

Deviation FitComparison::deviation_of(const BezierPatch& patch,
                                      const geometry::Trim& trim,
                                      bool follows_outline,
                                      int points,
                                      const Progress& progress) const {
    Deviation deviation = target_->face != nullptr
                              ? deviation_of_face(*target_, points, patch, progress)
                              : deviation_of_points(target_->side.mesh.points, patch, progress);
    measure_patch(deviation, patch, trim, progress);
    refuse_leaving(deviation, *target_, follows_outline);
    return deviation;
}

} // namespace millwright::exchange
