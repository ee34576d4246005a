#include "core/exchange/patch_fit.h"

#include "core/base/error.h"
#include "core/exchange/cloud_fit.h"
#include "core/exchange/internal/fit_deviation.h"
#include "core/exchange/internal/harmonic_parametrization.h"
#include "core/exchange/internal/least_squares.h"
#include "core/exchange/internal/visible_side.h"
#include "core/geometry/closest_point.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace millwright::exchange {

namespace {

using geometry::BezierPatch;

void check(const FitSettings& settings) {
    const auto fits = [](int degree) { return degree >= 1 && degree <= max_fit_degree; };
    expects(fits(settings.degree_u) && fits(settings.degree_v), "a degree that can be fitted");
    expects(settings.points >= 100 && settings.rounds >= 1, "points and rounds enough for a fit");
    expects(!settings.along || std::abs(settings.along->norm() - 1.0) < 1e-9, "a unit direction");
}

/// Points on the triangles and on the outline, where the square has them.
std::vector<Sample> samples_on(const HarmonicParametrization& map, const FitTarget& target, int count) {
    constexpr int points_per_edge_on_average = 4;
    std::vector<Sample> samples;
    for (const Spread& spread : spread_over(target.side.mesh, target.side.area, count)) {
        samples.push_back({target.at(spread), spread.of(map.places), std::nullopt});
    }
    const int each =
        std::clamp<int>(count / (points_per_edge_on_average * static_cast<int>(map.outline.size())), 1, 20);
    for (const OutlineEdge& edge : map.outline) {
        for (int k = 0; k < each; ++k) {
            const double share = (k + 0.5) / each;
            const Spread spread{{edge.from, edge.to, edge.to}, {1.0 - share, share, 0.0}};
            // The last corner of a side has its place on the next side.
            samples.push_back({target.at(spread), kept_on(edge.side, spread.of(map.places)), edge.side});
        }
    }
    return samples;
}

std::vector<Sample> samples_in(const Rectangle& rectangle, const FitTarget& target, int count) {
    std::vector<Sample> samples;
    for (const Spread& spread : spread_over(target.side.mesh, target.side.area, count)) {
        const Vec3 point = target.at(spread);
        samples.push_back({point, rectangle.place_of(point).cwiseMax(0.0).cwiseMin(1.0), std::nullopt});
    }
    return samples;
}

/// Least squares and corrected parameters in turn, as long as each round brings a hundredth and folds no more
/// than the round before: points that slide along the sides can turn a corner over.
FitRounds approach(const LeastSquares& squares,
                   std::vector<Sample> samples,
                   const FitComparison& comparison,
                   int rounds,
                   const Progress& progress) {
    constexpr double worth_going_on = 0.99; // of the distance of the round before
    FitRounds best{squares.solve(by_distance(samples), progress), 1};
    double folded = comparison.fold_of(best.patch, progress).share;
    best.rms = correct_parameters(samples, best.patch, progress);
    for (; best.rounds < rounds; ++best.rounds) {
        progress.report(static_cast<double>(best.rounds) / rounds, "fitting the patch");
        BezierPatch next = squares.solve(by_tangents(samples, best.patch), progress);
        const double smaller = correct_parameters(samples, next, progress);
        const double next_folded = comparison.fold_of(next, progress).share;
        if (!(smaller < best.rms) || next_folded > folded) {
            break;
        }
        const bool enough = smaller > worth_going_on * best.rms;
        best.patch = std::move(next);
        folded = next_folded;
        best.rms = smaller;
        if (enough) {
            break;
        }
    }
    return best;
}

/// Bending against distance, mm^2 against mm^2: where the mesh is everywhere it alone decides, empty corners
/// of a rectangle have to be held.
constexpr double everywhere_filled = 1e-13;
constexpr double partly_empty = 1e-8;

/// Few triangles for many control points leave the net free to go anywhere: smoothing grows until it stays
/// near the target, as long as that costs hardly any distance. A patch around a bend needs points far
/// outside.
FitRounds fair_fit(const std::vector<Sample>& samples,
                   const std::vector<Vec3>& target,
                   const FitSettings& settings,
                   double smoothness,
                   const FitComparison& comparison,
                   const Progress& progress) {
    constexpr double room = 0.25, more = 100.0, most_smoothness = 1e-4;
    constexpr double costs = 1.5, hardly = 1e-5; // of the rms without; of the diagonal
    const auto fit_with = [&](double weight) {
        const LeastSquares squares(settings.degree_u, settings.degree_v, weight);
        return approach(squares, samples, comparison, settings.rounds, progress);
    };
    Box3 box;
    for (const Vec3& point : target) {
        box.extend(point);
    }
    FitRounds fit = fit_with(smoothness);
    const double most_rms = costs * fit.rms + hardly * box.diagonal().norm();
    while (!stays_near(fit.patch, target, room) && smoothness < most_smoothness) {
        smoothness *= more;
        FitRounds smoother = fit_with(smoothness);
        if (!(smoother.rms <= most_rms)) {
            break;
        }
        fit = std::move(smoother);
    }
    return fit;
}

/// The loop on another patch near the face: each corner goes to the nearest point of that, and long edges get
/// more corners, because they need not stay straight.
geometry::Trim::Loop
moved_onto(const geometry::ClosestPointSearch& patch, const CadFace& face, const geometry::Trim::Loop& loop) {
    constexpr double longest = 1.0 / 16.0; // of an edge, in patches
    geometry::Trim::Loop moved;
    for (std::size_t n = 0; n < loop.size(); ++n) {
        const Vec2& a = loop[n];
        const Vec2 edge = loop[n + 1 == loop.size() ? 0 : n + 1] - a;
        const int pieces = std::max(1, static_cast<int>(std::ceil(edge.norm() / longest)));
        for (int k = 0; k < pieces; ++k) {
            const Vec2 at = a + static_cast<double>(k) / pieces * edge;
            const Vec2 start(at.x() / face.rows, at.y() / face.columns);
            moved.push_back(patch.closest(face.position(at), start).parameters);
        }
    }
    return moved;
}

geometry::Trim trim_on(const BezierPatch& patch, const CadFace& face, const Progress& progress) {
    const geometry::ClosestPointSearch search(patch);
    geometry::Trim trim;
    for (const geometry::Trim::Loop& loop : face.loops()) {
        progress.check();
        trim.loops.push_back(moved_onto(search, face, loop));
    }
    return trim;
}

/// `seen_from`: the unit direction from which the target is seen; nullopt for a whole face.
MeshFit fitted(FitTarget target,
               const std::optional<HarmonicParametrization>& square,
               const FitSettings& settings,
               const std::optional<Vec3>& seen_from,
               const Progress& progress) {
    const VisibleSide& side = target.side;
    std::vector<Sample> samples;
    if (square) {
        samples = samples_on(*square, target, settings.points);
    } else if (const auto rectangle = least_rectangle(side.mesh.points, *settings.along)) {
        samples = samples_in(*rectangle, target, settings.points);
    } else {
        throw Error("the points of the mesh lie on a line");
    }
    progress.report(0.1, "fitting the patch");
    const FitComparison comparison(target, seen_from);
    FitRounds fit = fair_fit(samples,
                             side.mesh.points,
                             settings,
                             square ? everywhere_filled : partly_empty,
                             comparison,
                             progress.part(0.1, 0.7));
    progress.report(0.7, "measuring the deviation");
    constexpr int denser = 4; // than what was fitted, and so other points
    geometry::Trim trim =
        target.face != nullptr ? trim_on(fit.patch, *target.face, progress) : geometry::Trim{};
    Deviation deviation =
        comparison.deviation_of(fit.patch, trim, square.has_value(), denser * settings.points, progress);
    return {std::move(fit.patch),
            std::move(trim),
            std::move(target.side.mesh),
            std::move(target.side.left_out),
            side.left_out_area,
            *settings.along,
            square.has_value(),
            target.outlines.corners,
            std::move(target.outlines.holes),
            std::move(deviation),
            fit.rounds};
}

/// The side of the target's mesh that is seen, by the way that the settings or the mesh itself say.
MeshFit fitted_side(FitTarget target,
                    const TriangleMesh& mesh,
                    const std::vector<Vec2>& places,
                    FitSettings settings,
                    const Progress& progress) {
    settings.along = settings.along.value_or(mean_direction(mesh));
    const Vec3& along = *settings.along;
    target.side = visible_side(mesh, along);
    if (target.side.mesh.triangles.empty()) {
        throw Error(fmt::format(
            "no triangle of the mesh faces ({:.3g}, {:.3g}, {:.3g})", along.x(), along.y(), along.z()));
    }
    if (target.face != nullptr) {
        for (const int number : target.side.numbers) {
            target.places.push_back(places[static_cast<std::size_t>(number)]);
        }
    }
    if (target.face == nullptr) { // which knows its own outline and holes
        target.outlines = outlines_of(target.side.mesh, along);
    }
    const auto rectangle = least_rectangle(target.side.mesh.points, along);
    const auto square = rectangle ? harmonic_parametrization(target.side.mesh, *rectangle) : std::nullopt;
    return fitted(std::move(target), square, settings, settings.along, progress);
}

/// Triangles with corners on a face, and where on it those are.
struct FaceMesh {
    TriangleMesh mesh;
    std::vector<Vec2> places;
    std::vector<OutlineEdge> outline; ///< of the whole raster of patches
};

FaceMesh triangles_of(const CadFace& face) {
    constexpr int steps = 24; // of a patch each way
    const int down = face.rows * steps;
    const int across = face.columns * steps;
    FaceMesh made;
    for (int i = 0; i <= down; ++i) {
        for (int j = 0; j <= across; ++j) {
            made.places.emplace_back(static_cast<double>(i) / steps, static_cast<double>(j) / steps);
            made.mesh.points.push_back(face.position(made.places.back()));
        }
    }
    const auto at = [&](int i, int j) { return i * (across + 1) + j; };
    for (int i = 0; i < down; ++i) {
        for (int j = 0; j < across; ++j) {
            made.mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            made.mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    }
    for (int i = 0; i < down; ++i) {
        made.outline.push_back({at(i, 0), at(i + 1, 0), 0});
        made.outline.push_back({at(i + 1, across), at(i, across), 2});
    }
    for (int j = 0; j < across; ++j) {
        made.outline.push_back({at(down, j), at(down, j + 1), 1});
        made.outline.push_back({at(0, j + 1), at(0, j), 3});
    }
    return made;
}

} // namespace

MeshFit fit_patch(const TriangleMesh& mesh, const FitSettings& settings, const Progress& progress) {
    check(settings);
    return fitted_side({}, mesh, {}, settings, progress);
}

MeshFit fit_face(const CadFace& face, FitSettings settings, const Progress& progress) {
    check(settings);
    FaceMesh made = triangles_of(face);
    FitTarget target;
    target.face = &face;
    if (settings.along) {
        return fitted_side(std::move(target), made.mesh, made.places, settings, progress);
    }
    settings.along = mean_direction(made.mesh);
    HarmonicParametrization own{{}, std::move(made.outline)};
    for (const Vec2& place : made.places) {
        own.places.push_back(place.cwiseQuotient(Vec2(face.rows, face.columns)));
    }
    for (std::size_t n = 0; n < made.mesh.triangles.size(); ++n) {
        target.side.area += 0.5 * made.mesh.doubled_area(n).norm();
    }
    target.side.mesh = std::move(made.mesh);
    target.places = std::move(made.places);
    return fitted(std::move(target), own, settings, std::nullopt, progress);
}

} // namespace millwright::exchange
