#include "core/project/imported_surface.h"

#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/exchange/grid_surface.h"
#include "core/exchange/point_rows.h"
#include "core/project/internal/imported_points.h"
#include "core/project/internal/joined_faults.h"
#include "core/project/internal/part_size.h"
#include "core/project/setting_tables.h"
#include "core/project/surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::project {

namespace {

using exchange::CadFace;
using exchange::CadModel;
using exchange::TriangleMesh;

exchange::FitSettings fit_settings(const ImportChoice& choice) {
    const FitDegrees degrees = choice.degrees.value_or(FitDegrees{});
    exchange::FitSettings settings;
    settings.degree_u = degrees.u;
    settings.degree_v = degrees.v;
    settings.along = choice.along;
    return settings;
}

void take_fit(ImportedSurface& imported, exchange::MeshFit fit) {
    imported.surface.patches = {fit.patch.net()};
    if (fit.left_out_area > 0.0) {
        imported.notes.push_back(
            fmt::format("{:.4g} mm2 of the mesh face away or sideways and were skipped", fit.left_out_area));
    }
    if (!fit.follows_outline) {
        imported.notes.push_back(fmt::format("the mesh is not a sheet with four corners: the patch covers "
                                             "the rectangle around it and is up to {:.3g} mm from the mesh",
                                             fit.deviation.patch_max));
    }
    if (!fit.holes.empty()) {
        imported.warnings.push_back(
            fmt::format("the mesh has {}, {:.3g} mm wide: the patch is fitted across, and so the tool cuts "
                        "where there is no material; cut the mesh into parts beside it, or keep the tool off",
                        fit.holes.size() == 1 ? std::string("a hole")
                                              : fmt::format("{} holes, the largest", fit.holes.size()),
                        fit.holes.front()));
    }
    Box3 box;
    for (const Vec3& point : fit.side.points) {
        box.extend(point);
    }
    constexpr double far_off = 0.03; // of the diagonal
    const double off = fit.follows_outline ? fit.deviation.largest() : fit.deviation.max;
    constexpr int corners_of_patch = 4;
    const bool has_other_outline = fit.follows_outline && fit.outline_corners > corners_of_patch;
    if (off > far_off * box.diagonal().norm() && has_other_outline) {
        imported.notes.push_back(
            fmt::format("the patch deviates by up to {:.3g} mm: the outline of the mesh has {} "
                        "corners and a patch has four; cut the mesh into parts with four "
                        "sides and import one at a time",
                        off,
                        fit.outline_corners));
    } else if (off > far_off * box.diagonal().norm()) {
        imported.notes.push_back(fmt::format("the patch deviates by up to {:.3g} mm: seen from this side the "
                                             "mesh folds over itself, or the degree is too low",
                                             off));
    }
    imported.fit = std::move(fit);
}

/// The points of a mesh that is a raster, so few that one patch goes through all of them.
std::optional<exchange::MeasuredPoints> points_for_one_patch(const TriangleMesh& mesh) {
    constexpr std::size_t most = exchange::most_points_of_one_span * exchange::most_points_of_one_span;
    auto points = mesh.points.size() <= most ? exchange::raster_points(mesh) : std::nullopt;
    const auto grid = points ? exchange::rows_of(*points, {}) : std::nullopt;
    const bool fits = grid && std::max(grid->rows, grid->columns) <= exchange::most_points_of_one_span;
    return fits ? std::move(points) : std::nullopt;
}

ImportedSurface import_mesh(const exchange::MeshFile& read,
                            const ImportChoice& choice,
                            const std::filesystem::path& file,
                            const Progress& progress) {
    const auto raster = choice.degrees ? std::nullopt : points_for_one_patch(read.mesh);
    if (raster) { // facets between so few points are no shape to fit
        ImportedSurface imported = import_points(*raster, choice, file, progress);
        imported.notes.insert(imported.notes.begin(), read.notes.begin(), read.notes.end());
        imported.notes.push_back(fmt::format(
            "the mesh joins {} rows of {} points: the patch goes through all of them, not along the "
            "facets; give a degree to fit the facets",
            imported.points->rows,
            imported.points->columns));
        return imported;
    }
    ImportedSurface imported;
    imported.notes = read.notes;
    if (read.without_area > 0) {
        imported.notes.push_back(
            read.without_area == 1
                ? std::string("1 triangle has no area and was skipped")
                : fmt::format("{} triangles have no area and were skipped", read.without_area));
    }
    take_fit(imported,
             exchange::fit_patch(scaled(read.mesh, choice.mm_per_unit), fit_settings(choice), progress));
    return imported;
}

ImportedSurface fitted_face(const CadFace& face, const ImportChoice& choice, const Progress& progress) {
    ImportedSurface imported;
    take_fit(imported, exchange::fit_face(face, fit_settings(choice), progress));
    if (!imported.fit->trim.everything()) {
        imported.surface.trims = {imported.fit->trim};
    }
    return imported;
}

/// Its patches, but those that lie outside of its outline.
ImportedSurface face_as_it_is(const CadFace& face) {
    ImportedSurface imported;
    SurfaceInput& surface = imported.surface;
    for (int row = 0; row < face.rows; ++row) {
        for (int column = 0; column < face.columns; ++column) {
            if (const auto trim = face.trim_of(row, column)) {
                surface.patches.push_back(
                    face.patches[static_cast<std::size_t>(row * face.columns + column)].net());
                surface.trims.push_back(*trim);
            }
        }
    }
    if (surface.patches.empty()) {
        throw Error(fmt::format("nothing of face {} lies inside its outline", face.number));
    }
    if (std::ranges::all_of(surface.trims, &geometry::Trim::everything)) {
        surface.trims.clear();
    }
    if (surface.patches.size() > 1) {
        imported.notes.push_back(fmt::format(
            "face {} has {} patches and only the first is machined; import the exact face (--exact) or fit "
            "one patch to machine all of it",
            face.number,
            surface.patches.size()));
    }
    return imported;
}

/// All of it as one surface. A single patch is that already.
ImportedSurface exact_face(const CadFace& face) {
    if (face.patches.size() == 1) {
        return face_as_it_is(face);
    }
    if (!face.bspline) {
        throw Error(fmt::format("face {} cannot be imported as one exact surface: its surface breaks at a "
                                "knot, or its weights differ too much",
                                face.number),
                    {},
                    "fit one patch to it (--degree)");
    }
    ImportedSurface imported;
    imported.surface.face = FaceInput{*face.bspline, face.bspline_trim()};
    return imported;
}

const CadFace& chosen_face(const exchange::CadModel& model, const std::filesystem::path& file, int number) {
    if (number == 0 && model.faces.size() == 1) {
        return model.faces.front();
    }
    if (number == 0) {
        throw Error("the file has " + counted(model.faces.size(), "face"), file, "select one by its number");
    }
    const auto found = std::ranges::find(model.faces, number, &CadFace::number);
    if (found == model.faces.end()) {
        throw Error(fmt::format("the file has no usable face {}", number), file);
    }
    return *found;
}

/// A patch as a surface of one span.
geometry::BsplineNet in_one_span(const geometry::ControlNet& patch) {
    const auto knots = [](int degree) {
        std::vector<double> ends(2 * static_cast<std::size_t>(degree + 1), 1.0);
        std::fill_n(ends.begin(), degree + 1, 0.0);
        return ends;
    };
    geometry::BsplineNet net;
    net.degree_u = patch.rows - 1;
    net.degree_v = patch.columns - 1;
    net.knots_u = knots(net.degree_u);
    net.knots_v = knots(net.degree_v);
    net.rows = patch.rows;
    net.columns = patch.columns;
    net.points = patch.points;
    net.weights = patch.weights;
    return net;
}

/// The faces of those numbers, before they are joined. Throws Error for a trimmed one.
JoinedInput
faces_to_join(const CadModel& model, const std::filesystem::path& file, const std::vector<int>& numbers) {
    JoinedInput joined;
    for (const int number : numbers) {
        const CadFace& face = chosen_face(model, file, number);
        if (face.trimmed()) {
            throw Error(fmt::format("face {}: {}", number, no_joined_trim),
                        file,
                        "choose faces that have all of their four sides");
        }
        const bool broken = face.patches.size() > 1 && !face.bspline;
        if (broken) {
            throw Error(fmt::format("face {} cannot be taken as one exact surface: its surface breaks at a "
                                    "knot, or its weights differ too much",
                                    number),
                        file,
                        "choose other faces");
        }
        joined.faces.push_back(
            {number, {face.bspline ? *face.bspline : in_one_span(face.patches.front().net()), {}}});
    }
    if (std::string fault = fault_of_count(joined.faces.size()); !fault.empty()) {
        throw Error(fault, file);
    }
    return joined;
}

/// They are joined once to see whether they can be: a project of faces that cannot has no plan.
ImportedSurface joined_faces(const CadModel& model,
                             const std::filesystem::path& file,
                             const std::vector<int>& numbers,
                             const Progress& progress) {
    ImportedSurface imported;
    if (numbers.size() == 1) {
        return import_face(
            chosen_face(model, file, numbers.front()), {.face = numbers.front(), .exact = true}, progress);
    }
    imported.surface.joined = faces_to_join(model, file, numbers);
    try {
        imported.joined =
            std::make_shared<const region::JoinedRegion>(joined_region(*imported.surface.joined, progress));
    } catch (const Error& fault) {
        const Diagnostic& told = fault.diagnostic();
        throw Error(told.message, file, told.hint);
    }
    return imported;
}

/// Between its corners, mm.
double largest_hole(const CadFace& face) {
    double largest = 0.0;
    for (const std::vector<Vec2>& hole : face.holes) {
        std::vector<Vec3> corners;
        for (const Vec2& place : hole) {
            corners.push_back(face.position(place));
        }
        for (const Vec3& corner : corners) {
            for (const Vec3& other : corners) {
                largest = std::max(largest, (corner - other).norm());
            }
        }
    }
    return largest;
}

/// Before it is fitted, which makes noise of it.
void check_imported_size(const std::string& what,
                         const std::vector<Vec3>& points,
                         double mm_per_unit,
                         const std::filesystem::path& file) {
    const double size = mm_per_unit * size_of(points);
    if (const std::string fault = fault_of_size(size); !fault.empty()) {
        throw Error(what + " " + fault, file, question_of_unit(size / mm_per_unit));
    }
}

/// Throws Error with `hint` about what is too small.
void check_imported_size(const ImportedSurface& imported,
                         const std::string& hint,
                         const std::filesystem::path& file) {
    std::vector<Vec3> points;
    for (const geometry::ControlNet& net : imported.surface.patches) {
        points.insert(points.end(), net.points.begin(), net.points.end());
    }
    for (const FaceInput* face : imported.surface.exact_faces()) {
        points.insert(points.end(), face->net.points.begin(), face->net.points.end());
    }
    if (const std::string fault = fault_of_size(size_of(points)); !fault.empty()) {
        throw Error("the surface " + fault, file, hint);
    }
}

void tell(ImportedSurface& imported, std::string doubt) {
    if (!doubt.empty()) {
        imported.notes.push_back(std::move(doubt));
    }
}

std::string question_of_cad_unit(const CadModel& model) {
    return fmt::format("check the unit; the file names {}", model.unit);
}

constexpr double doubtful_mm = 1.0; // hardly anyone cuts what is smaller

void check_reach(const ImportedSurface& imported, const std::filesystem::path& file) {
    const auto check = [&](const std::vector<Vec3>& points) {
        for (const Vec3& point : points) {
            if (!(point.cwiseAbs().maxCoeff() <= farthest_point_mm)) {
                throw Error(
                    fmt::format("a control point is farther than {} mm from the origin", farthest_point_mm),
                    file,
                    "check the unit");
            }
        }
    };
    for (const geometry::ControlNet& net : imported.surface.patches) {
        check(net.points);
    }
    for (const FaceInput* face : imported.surface.exact_faces()) {
        check(face->net.points);
    }
}

/// Before it is fitted: a patch near points that are too far away is one that cannot be made.
void check_reach(const std::string& what,
                 const std::vector<Vec3>& points,
                 double mm_per_unit,
                 const std::filesystem::path& file) {
    for (const Vec3& point : points) {
        const double far = mm_per_unit * point.cwiseAbs().maxCoeff();
        if (!(far <= farthest_point_mm)) {
            throw Error(fmt::format("a point of {} is {:g} mm from the origin, farther than {} mm",
                                    what,
                                    far,
                                    farthest_point_mm),
                        file,
                        "check the unit");
        }
    }
}

} // namespace

std::vector<int> chosen_faces(const CadModel& model, const ImportChoice& choice) {
    if (!choice.joined.empty()) {
        return choice.joined;
    }
    const bool one_alone = choice.face == 0 && model.faces.size() == 1;
    const int number = one_alone ? model.faces.front().number : choice.face;
    return number > 0 ? std::vector{number} : std::vector<int>{};
}

ImportChoice with_face(ImportChoice choice, int number) {
    if (choice.joined.empty()) {
        choice.face = number;
        return choice;
    }
    const auto found = std::ranges::find(choice.joined, number);
    if (found == choice.joined.end()) {
        choice.joined.push_back(number);
    } else if (choice.joined.size() > 1) {
        choice.joined.erase(found);
    }
    return choice;
}

bool is_importable(const std::filesystem::path& file) {
    return exchange::is_mesh_file(file) || exchange::is_cad_file(file) ||
           exchange::is_measured_point_file(file);
}

bool opens_as_surface(const std::filesystem::path& file) {
    return is_importable(file) && !exchange::has_common_point_name(file);
}

std::string doubt_of_size(double size_mm, double mm_per_unit) {
    return size_mm < doubtful_mm ? fmt::format("the whole part is only {:.3g} mm in size: {}",
                                               size_mm,
                                               question_of_unit(size_mm / mm_per_unit))
                                 : std::string();
}

std::string doubt_of_size(const CadModel& model) {
    Box3 box;
    for (const CadFace& face : model.faces) {
        box.extend(face.box);
    }
    const double size = box.isEmpty() ? doubtful_mm : box.sizes().maxCoeff();
    return size < doubtful_mm ? fmt::format("the whole part is only {:.3g} mm in size: {}",
                                            size,
                                            question_of_cad_unit(model))
                              : std::string();
}

ImportedSurface import_face(const CadFace& face, const ImportChoice& choice, const Progress& progress) {
    ImportedSurface imported = choice.degrees ? fitted_face(face, choice, progress)
                               : choice.exact ? exact_face(face)
                                              : face_as_it_is(face);
    if (!face.holes.empty()) {
        imported.notes.push_back(
            fmt::format("the face has {}, {:.3g} mm wide: paths cross it, since they fill "
                        "whole patches",
                        face.holes.size() == 1 ? std::string("a hole")
                                               : fmt::format("{} holes, the largest", face.holes.size()),
                        largest_hole(face)));
    }
    return imported;
}

ImportSource read_source(const std::filesystem::path& file, const Progress& progress) {
    if (!is_importable(file)) {
        throw Error("this type of file cannot be imported", file, importable_kinds);
    }
    ImportSource source;
    source.file = file;
    if (exchange::is_mesh_file(file)) {
        source.mesh = exchange::read_mesh(file, 1.0, progress);
    } else if (exchange::is_measured_point_file(file)) {
        source.points = exchange::read_measured_points(file, progress);
    } else {
        source.model = exchange::read_cad(file, progress);
    }
    return source;
}

ImportedSurface import_of(const ImportSource& source, const ImportChoice& choice, const Progress& progress) {
    ImportedSurface imported;
    if (source.mesh || source.points) {
        const std::vector<Vec3>& points = source.mesh ? source.mesh->mesh.points : source.points->points;
        const std::string what = source.mesh ? "the mesh" : "the cloud";
        const double unit = choice.mm_per_unit;
        check_reach(what, points, unit, source.file);
        check_imported_size(what, points, unit, source.file);
        imported = source.mesh ? import_mesh(*source.mesh, choice, source.file, progress)
                               : import_points(*source.points, choice, source.file, progress);
        tell(imported, doubt_of_size(unit * size_of(points), unit));
    } else {
        const exchange::CadModel& model = *source.model;
        imported = choice.joined.empty()
                       ? import_face(chosen_face(model, source.file, choice.face), choice, progress)
                       : joined_faces(model, source.file, choice.joined, progress);
        const std::size_t taken = std::max<std::size_t>(choice.joined.size(), 1);
        if (model.faces.size() > taken) {
            tell(imported,
                 fmt::format("only {} of {} faces {} imported: the tool is not checked against the others",
                             taken == 1 ? "one" : std::to_string(taken),
                             model.faces.size(),
                             taken == 1 ? "is" : "are"));
        }
        imported.notes.insert(imported.notes.end(), model.notes.begin(), model.notes.end());
        imported.notes.insert(imported.notes.end(), model.left_out.begin(), model.left_out.end());
        check_imported_size(imported, question_of_cad_unit(model), source.file);
        tell(imported, doubt_of_size(model));
    }
    check_reach(imported, source.file);
    return imported;
}

ImportedSurface
import_surface(const std::filesystem::path& file, const ImportChoice& choice, const Progress& progress) {
    return import_of(read_source(file, progress.part(0.0, 0.4)), choice, progress.part(0.4, 1.0));
}

} // namespace millwright::project
