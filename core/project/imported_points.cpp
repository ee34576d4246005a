#include "core/project/internal/imported_points.h"

#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/exchange/cloud_fit.h"
#include "core/exchange/grid_surface.h"
#include "core/exchange/point_rows.h"
#include "core/geometry/patch_refinement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace millwright::project {

namespace {

using exchange::CadFace;

/// The point of the cloud or of the rows that is farthest from the surface.
std::size_t worst_point(const exchange::Deviation& deviation) {
    const auto worst =
        std::ranges::max_element(deviation.at_points, {}, [](double d) { return std::abs(d); });
    return static_cast<std::size_t>(worst - deviation.at_points.begin());
}

ImportedSurface
import_cloud(const exchange::MeasuredPoints& read, const ImportChoice& choice, const Progress& progress) {
    exchange::PointCloud cloud = exchange::cloud_of(read);
    for (Vec3& point : cloud.points) {
        point *= choice.mm_per_unit;
    }
    ImportedSurface imported;
    if (!cloud.repeated.empty()) {
        imported.notes.push_back(
            fmt::format("{} skipped, the first in line {}",
                        counted(cloud.repeated.size(), "duplicate point", "duplicate points"),
                        cloud.repeated.front()));
    }
    const int degree = exchange::cloud_degree(cloud.points.size());
    const FitDegrees degrees = choice.degrees.value_or(FitDegrees{degree, degree});
    exchange::FitSettings settings;
    settings.degree_u = degrees.u;
    settings.degree_v = degrees.v;
    settings.along = choice.along;
    exchange::MeshFit fit = exchange::fit_cloud(cloud.points, settings, progress);
    imported.surface.patches = {fit.patch.net()};
    imported.points = PointFit{0, 0, std::move(cloud.points), std::move(cloud.lines), fit.deviation};
    imported.fit = std::move(fit);
    return imported;
}

/// Exactly through the points.
exchange::Deviation deviation_of_rows(const exchange::GridSurface& through) {
    exchange::Deviation deviation;
    double squares = 0.0;
    for (std::size_t n = 0; n < through.places.size(); ++n) {
        const double off = (through.face.position(through.places[n]) - through.grid.points[n]).norm();
        deviation.at_points.push_back(off);
        deviation.max = std::max(deviation.max, off);
        deviation.mean += off / static_cast<double>(through.places.size());
        squares += off * off;
    }
    deviation.rms = std::sqrt(squares / static_cast<double>(through.places.size()));
    return deviation;
}

/// One patch as it is, of the degrees that are asked for, or nothing if they are too low for it.
std::optional<geometry::BezierPatch> exact_patch(const CadFace& face, const FitDegrees& degrees) {
    const geometry::BezierPatch& patch = face.patches.front();
    const bool same =
        face.patches.size() == 1 && degrees.u >= patch.degree_u() && degrees.v >= patch.degree_v();
    return same ? std::optional(geometry::elevated(patch, degrees.u, degrees.v)) : std::nullopt;
}

ImportedSurface import_rows(exchange::PointGrid grid, const ImportChoice& choice, const Progress& progress) {
    for (Vec3& point : grid.points) {
        point *= choice.mm_per_unit;
    }
    exchange::GridSurface through =
        exchange::surface_through(std::move(grid), choice.along, progress.part(0.0, 0.3));
    ImportedSurface imported;
    PointFit points{through.grid.rows, through.grid.columns, {}, {}, deviation_of_rows(through)};
    const auto exact = choice.degrees ? exact_patch(through.face, *choice.degrees) : std::nullopt;
    if (exact) {
        imported.surface.patches = {exact->net()};
    } else if (choice.degrees) {
        imported = import_face(through.face, choice, progress.part(0.3, 1.0));
        points.deviation = exchange::deviation_of_points(through.grid.points, imported.fit->patch, progress);
    } else if (through.face.bspline) { // all of it is machined
        imported.surface.face = FaceInput{*through.face.bspline, through.face.bspline_trim()};
    } else {
        imported.surface.patches = {through.face.patches.front().net()};
    }
    points.points = std::move(through.grid.points);
    points.lines = std::move(through.grid.lines);
    imported.points = std::move(points);
    return imported;
}

} // namespace

int PointFit::worst_line() const {
    return lines[worst_point(deviation)];
}

ImportedSurface import_points(const exchange::MeasuredPoints& read,
                              const ImportChoice& choice,
                              const std::filesystem::path& file,
                              const Progress& progress) {
    try {
        std::optional<exchange::PointGrid> grid;
        if (!choice.cloud) {
            grid = exchange::rows_of(read, file);
        }
        ImportedSurface imported =
            grid ? import_rows(*std::move(grid), choice, progress) : import_cloud(read, choice, progress);
        imported.notes.insert(imported.notes.begin(), read.notes.begin(), read.notes.end());
        return imported;
    } catch (const Error& error) {
        Diagnostic about = error.diagnostic();
        if (about.place.file.empty()) {
            about.place.file = file; // what is wrong with all points together
        }
        throw Error(std::move(about));
    }
}

} // namespace millwright::project
