#include "app/plan/import_command.h"

#include "app/command_line/option_values.h"
#include "app/command_line/watched_work.h"
#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/text.h"
#include "core/exchange/mesh_file.h"
#include "core/exchange/point_rows.h"
#include "core/project/imported_surface.h"
#include "core/project/project_file.h"
#include "core/region/flattening.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace millwright::app {

namespace {

using nlohmann::ordered_json;

struct ImportOptions {
    std::string file;
    std::string out;                   ///< a project; empty: only the faces are listed
    std::string deviation;             ///< comma-separated; empty: none
    std::string degrees;               ///< as "5" or "5x3"; empty: as it is
    std::string along;                 ///< empty: found
    std::optional<double> mm_per_unit; ///< of a mesh
    int face = 0;
    std::vector<int> faces; ///< that are joined
    bool exact = false;
    bool cloud = false;
    bool json = false;
};

const std::map<std::string, Vec3> directions{{"+x", Vec3(1, 0, 0)},
                                             {"-x", Vec3(-1, 0, 0)},
                                             {"+y", Vec3(0, 1, 0)},
                                             {"-y", Vec3(0, -1, 0)},
                                             {"+z", Vec3(0, 0, 1)},
                                             {"-z", Vec3(0, 0, -1)}};

/// Nothing unless `text` is one degree, or two with an x between them.
std::optional<project::FitDegrees> degrees_from(const std::string& text) {
    const auto number = [](std::string_view part) {
        int value = 0;
        const auto [end, fault] = std::from_chars(part.data(), part.data() + part.size(), value);
        const bool whole = fault == std::errc{} && end == part.data() + part.size();
        return whole && value >= 1 && value <= exchange::max_fit_degree ? value : 0;
    };
    const std::size_t between = text.find('x');
    project::FitDegrees degrees;
    degrees.u = number(std::string_view(text).substr(0, between));
    degrees.v = between == std::string::npos ? degrees.u : number(std::string_view(text).substr(between + 1));
    return degrees.u > 0 && degrees.v > 0 ? std::optional(degrees) : std::nullopt;
}

std::string fault_of_degrees(const std::string& text) {
    return degrees_from(text) ? std::string()
                              : fmt::format("'{}' is not a degree from 1 to {}, or two such as 5x3",
                                            text,
                                            exchange::max_fit_degree);
}

project::ImportChoice choice_of(const ImportOptions& options) {
    project::ImportChoice choice{.face = options.face,
                                 .mm_per_unit = options.mm_per_unit.value_or(1.0),
                                 .joined = options.faces,
                                 .exact = options.exact,
                                 .cloud = options.cloud};
    if (!options.degrees.empty()) {
        choice.degrees = degrees_from(options.degrees);
    }
    if (!options.along.empty()) {
        choice.along = directions.at(options.along);
    }
    return choice;
}

ordered_json face_json(const exchange::CadFace& face) {
    int degree_u = 0;
    int degree_v = 0;
    for (const geometry::BezierPatch& patch : face.patches) {
        degree_u = std::max(degree_u, patch.degree_u());
        degree_v = std::max(degree_v, patch.degree_v());
    }
    const Vec3 size = face.box.sizes();
    return {
        {"number", face.number},
        {"patches", {face.rows, face.columns}},
        {"degree", {degree_u, degree_v}},
        {"rational", std::ranges::any_of(face.patches, [](const auto& patch) { return patch.rational(); })},
        {"trimmed", face.trimmed()},
        {"size_mm", {size.x(), size.y(), size.z()}}};
}

/// The notes of a file, and whether all of it is so small that the unit is doubtful.
std::vector<std::string> with_doubt(std::vector<std::string> notes, std::string doubt) {
    if (!doubt.empty()) {
        notes.push_back(std::move(doubt));
    }
    return notes;
}

ordered_json model_json(const exchange::CadModel& model) {
    ordered_json faces = ordered_json::array();
    for (const exchange::CadFace& face : model.faces) {
        faces.push_back(face_json(face));
    }
    return {{"unit", model.unit},
            {"faces", std::move(faces)},
            {"left_out", model.left_out},
            {"notes", with_doubt(model.notes, project::doubt_of_size(model))}};
}

void print_import_notes(const std::vector<std::string>& notes) {
    for (const std::string& note : notes) {
        fmt::print(stderr, "note: {}\n", note);
    }
}

void print_model(const ordered_json& model) {
    fmt::print(
        "{:>6} {:>9} {:>7} {:>9} {:>8}  size mm\n", "face", "patches", "degree", "rational", "trimmed");
    for (const ordered_json& face : model["faces"]) {
        const auto pair = [&](const char* key) {
            return fmt::format("{} x {}", face[key][0].get<int>(), face[key][1].get<int>());
        };
        const auto size = [&](int axis) { return fixed(face["size_mm"][axis].get<double>(), 3); };
        fmt::print("{:>6} {:>9} {:>7} {:>9} {:>8}  {} x {} x {}\n",
                   face["number"].get<int>(),
                   pair("patches"),
                   pair("degree"),
                   face["rational"].get<bool>() ? "yes" : "no",
                   face["trimmed"].get<bool>() ? "yes" : "no",
                   size(0),
                   size(1),
                   size(2));
    }
    for (const ordered_json& reason : model["left_out"]) {
        fmt::print(stderr, "note: skipped: {}\n", reason.get<std::string>());
    }
    fmt::print("unit of the file: {}\n", model["unit"].get<std::string>());
}

ordered_json mesh_json(const exchange::MeshFile& read, double mm_per_unit) {
    Box3 box;
    for (const Vec3& point : read.mesh.points) {
        box.extend(point);
    }
    const Vec3 size = box.sizes();
    return {{"points", read.mesh.points.size()},
            {"triangles", read.mesh.triangles.size()},
            {"without_area", read.without_area},
            {"size_mm", {size.x(), size.y(), size.z()}},
            {"notes", with_doubt(read.notes, project::doubt_of_size(size.maxCoeff(), mm_per_unit))}};
}

void print_mesh(const ordered_json& mesh) {
    const auto size = [&](int axis) { return fixed(mesh["size_mm"][axis].get<double>(), 3); };
    fmt::print("{}, {}, {} without area\n{} x {} x {} mm\n",
               counted(mesh["points"].get<std::size_t>(), "point"),
               counted(mesh["triangles"].get<std::size_t>(), "triangle"),
               mesh["without_area"].get<int>(),
               size(0),
               size(1),
               size(2));
}

ordered_json points_json(const exchange::MeasuredPoints& read, const ImportOptions& options) {
    const auto grid = options.cloud ? std::nullopt : exchange::rows_of(read, options.file);
    const double unit = options.mm_per_unit.value_or(1.0);
    Box3 box;
    for (const Vec3& point : read.points) {
        box.extend(unit * point);
    }
    const Vec3 size = box.sizes();
    return {{"points", read.points.size()},
            {"rows", grid ? grid->rows : 0},
            {"columns", grid ? grid->columns : 0},
            {"size_mm", {size.x(), size.y(), size.z()}},
            {"notes", with_doubt(read.notes, project::doubt_of_size(size.maxCoeff(), unit))}};
}

std::string rows_text(int rows, int columns) {
    return rows == 0 ? "no rows (point cloud)"
                     : fmt::format("{} of {}", counted(rows, "row"), counted(columns, "point"));
}

void print_points(const ordered_json& points) {
    const auto size = [&](int axis) { return fixed(points["size_mm"][axis].get<double>(), 3); };
    fmt::print("{}, {}\n{} x {} x {} mm\n",
               counted(points["points"].get<std::size_t>(), "point"),
               rows_text(points["rows"].get<int>(), points["columns"].get<int>()),
               size(0),
               size(1),
               size(2));
}

int tell_of(const ImportOptions& options) {
    WatchedWork work;
    const bool is_mesh = exchange::is_mesh_file(options.file);
    const bool is_points = exchange::is_measured_point_file(options.file);
    const double unit = options.mm_per_unit.value_or(1.0);
    const ordered_json told =
        is_mesh     ? mesh_json(exchange::read_mesh(options.file, unit, work.progress()), unit)
        : is_points ? points_json(exchange::read_measured_points(options.file, work.progress()), options)
                    : model_json(exchange::read_cad(options.file, work.progress()));
    work.finish();
    print_import_notes(told["notes"].get<std::vector<std::string>>());
    if (options.json) {
        fmt::print("{}\n", told.dump(2));
    } else if (is_mesh) {
        print_mesh(told);
    } else if (is_points) {
        print_points(told);
    } else {
        print_model(told);
    }
    return 0;
}

/// Of the points of the file, or of a mesh or face.
std::string deviation_csv(const project::ImportedSurface& imported) {
    const std::vector<Vec3>& points = imported.points ? imported.points->points : imported.fit->side.points;
    const exchange::Deviation& deviation =
        imported.points ? imported.points->deviation : imported.fit->deviation;
    std::string text = "x_mm,y_mm,z_mm,deviation_mm\n";
    for (std::size_t n = 0; n < points.size(); ++n) {
        const Vec3& at = points[n];
        fmt::format_to(std::back_inserter(text),
                       "{:.6f},{:.6f},{:.6f},{:.6f}\n",
                       at.x(),
                       at.y(),
                       at.z(),
                       deviation.at_points[n]);
    }
    return text;
}

ordered_json imported_json(const project::ImportedSurface& imported) {
    ordered_json json{{"patches", imported.surface.patches.size()},
                      {"notes", imported.notes},
                      {"warnings", imported.warnings}};
    if (const auto& face = imported.surface.face) {
        const auto [u, v] = geometry::BsplineSurface(face->net).spans();
        json["face"] = {{"degree", {face->net.degree_u, face->net.degree_v}},
                        {"spans", {u, v}},
                        {"trimmed", !face->trim.everything()}};
    }
    if (const auto& joined = imported.joined) {
        ordered_json numbers = ordered_json::array();
        for (const project::JoinedFace& face : imported.surface.joined->faces) {
            numbers.push_back(face.number);
        }
        json["joined"] = {{"faces", std::move(numbers)},
                          {"flattening", std::string(region::name_of(joined->flattening.method))},
                          {"distortion", joined->flattening.distortion},
                          {"boundary_off_mm", joined->boundary_off}};
    }
    if (const auto& points = imported.points) {
        json["points"] = {{"count", points->points.size()},
                          {"rows", points->rows},
                          {"columns", points->columns},
                          {"max_mm", points->deviation.max},
                          {"mean_mm", points->deviation.mean},
                          {"rms_mm", points->deviation.rms},
                          {"worst_line", points->worst_line()}};
    } else if (const auto& fit = imported.fit) {
        json["fit"] = {{"degree", {fit->patch.degree_u(), fit->patch.degree_v()}},
                       {"rounds", fit->rounds},
                       {"follows_outline", fit->follows_outline},
                       {"holes_mm", fit->holes},
                       {"max_mm", fit->deviation.max},
                       {"mean_mm", fit->deviation.mean},
                       {"rms_mm", fit->deviation.rms},
                       {"patch_max_mm", fit->deviation.patch_max},
                       {"patch_mean_mm", fit->deviation.patch_mean}};
    }
    return json;
}

void print_points_off(const project::PointFit& points,
                      const project::SurfaceInput& surface,
                      const char* numbered) {
    const exchange::Deviation& off = points.deviation;
    fmt::print("{}, {}\n", counted(points.points.size(), "point"), rows_text(points.rows, points.columns));
    if (!surface.face) {
        const geometry::ControlNet& net = surface.patches.front();
        fmt::print("patch of degree {} x {}\n", net.rows - 1, net.columns - 1);
    }
    fmt::print("points to surface: at most {:.4g} mm ({} {}), {:.4g} mm on average, {:.4g} mm rms\n",
               off.max,
               numbered,
               points.worst_line(),
               off.mean,
               off.rms);
}

void print_imported(const project::ImportedSurface& imported, const ImportOptions& options) {
    print_import_notes(imported.notes);
    for (const std::string& warning : imported.warnings) {
        fmt::print(stderr, "warning: {}\n", warning);
    }
    if (options.json) {
        fmt::print("{}\n", imported_json(imported).dump(2));
        return;
    }
    if (const auto& points = imported.points) {
        print_points_off(*points, imported.surface, exchange::is_mesh_file(options.file) ? "point" : "line");
    } else if (const auto& fit = imported.fit) {
        const char* source = exchange::is_mesh_file(options.file) ? "mesh" : "face";
        fmt::print("patch of degree {} x {}\n"
                   "{} to patch: at most {} mm, {} mm on average, {} mm rms\n"
                   "patch to {}: at most {} mm, {} mm on average\n",
                   fit->patch.degree_u(),
                   fit->patch.degree_v(),
                   source,
                   fixed(fit->deviation.max, 4),
                   fixed(fit->deviation.mean, 4),
                   fixed(fit->deviation.rms, 4),
                   source,
                   fixed(fit->deviation.patch_max, 4),
                   fixed(fit->deviation.patch_mean, 4));
    }
    if (const auto& joined = imported.joined) {
        fmt::print("{} exact faces joined: {}, distortion {}, {} mm from their boundary at most\n{}: {}\n",
                   imported.surface.joined->faces.size(),
                   region::name_of(joined->flattening.method),
                   fixed(joined->flattening.distortion, 3),
                   fixed(joined->boundary_off, 4),
                   options.out,
                   counted(imported.surface.joined->faces.size(), "face"));
        return;
    }
    if (const auto& face = imported.surface.face) {
        const auto [u, v] = geometry::BsplineSurface(face->net).spans();
        fmt::print("exact face of degree {} x {}, {} x {} spans\n{}: 1 face\n",
                   face->net.degree_u,
                   face->net.degree_v,
                   u,
                   v,
                   options.out);
        return;
    }
    fmt::print("{}: {} {}\n",
               options.out,
               imported.surface.patches.size(),
               imported.surface.patches.size() == 1 ? "patch" : "patches");
}

void refuse_faces(const ImportOptions& options) {
    if (options.faces.empty()) {
        return;
    }
    if (options.face != 0) {
        throw UsageError("--face and --faces exclude each other", options.file, "leave one of them out");
    }
    if (!options.exact) {
        throw UsageError("--faces joins exact faces", options.file, "add --exact");
    }
}

int import_file(const ImportOptions& options) {
    if (!project::is_importable(options.file)) {
        throw Error("this type of file cannot be imported", options.file, project::importable_kinds);
    }
    if (options.mm_per_unit && exchange::is_cad_file(options.file)) {
        throw UsageError("--unit applies only to a mesh or to points",
                         options.file,
                         "leave it out: a STEP or IGES file states its unit");
    }
    if (options.cloud && !exchange::is_measured_point_file(options.file)) {
        throw UsageError("--cloud applies only to a file of points", options.file);
    }
    if (options.exact && !exchange::is_cad_file(options.file)) {
        throw UsageError("--exact applies only to a face of a STEP or IGES file", options.file);
    }
    if (options.exact && !options.degrees.empty()) {
        throw UsageError("--exact and --degree exclude each other", options.file, "leave one of them out");
    }
    refuse_faces(options);
    if (options.out.empty()) {
        return tell_of(options);
    }
    WatchedWork work;
    const project::ImportedSurface imported =
        project::import_surface(options.file, choice_of(options), work.progress());
    work.finish();
    if (!options.deviation.empty() && !imported.fit && !imported.points) {
        throw Error("--deviation needs a fitted patch", options.file, "give --degree");
    }
    project::Project made;
    made.name = std::filesystem::path(options.file).stem().string();
    made.surface = imported.surface;
    project::write_project(made, options.out);
    if (!options.deviation.empty()) {
        write_file(options.deviation, deviation_csv(imported));
    }
    print_imported(imported, options);
    constexpr int incomplete = 3;
    return imported.warnings.empty() ? 0 : incomplete;
}

} // namespace

void add_import_command(CLI::App& app, Command& chosen) {
    const auto options = std::make_shared<ImportOptions>();
    CLI::App& command =
        *app.add_subcommand("import", "Import a surface from another program, or list the faces of its file");
    command
        .add_option(
            "FILE", options->file, "STEP, IGES, STL, OBJ or PLY file, or points: CSV, XYZ, ASC, PTS or TXT")
        ->required();
    CLI::Option& out =
        *command.add_option("--out", options->out, "Project file to write; without it, only list the faces")
             ->type_name("PROJECT");
    command.add_option("--face", options->face, "Face number, for a STEP or IGES file with several faces")
        ->check(CLI::Range(1, exchange::most_cad_faces));
    command
        .add_option(
            "--faces",
            options->faces,
            "Numbers of faces that continue one another, separated by commas: machined as one surface, with "
            "--exact")
        ->delimiter(',')
        ->check(CLI::Range(1, exchange::most_cad_faces))
        ->type_name("N,N,...")
        ->needs(&out);
    command
        .add_option("--degree",
                    options->degrees,
                    "Fit one patch of this degree (default: a face is used as it is, a mesh is fitted with "
                    "5, rows of points are interpolated)")
        ->check(CLI::Validator(fault_of_degrees, "P or PxQ"))
        ->needs(&out);
    std::vector<std::string> names;
    for (const auto& [name, direction] : directions) {
        names.push_back(name);
    }
    command.add_option("--along", options->along, "Side of a mesh or of points (default: the visible side)")
        ->check(CLI::IsMember(names))
        ->needs(&out);
    const std::map<std::string, double> units{{"mm", 1.0}, {"cm", 10.0}, {"m", 1000.0}, {"inch", 25.4}};
    command
        .add_option("--unit",
                    options->mm_per_unit,
                    "Unit of a mesh or of points, whose file does not state it (default: mm)")
        ->transform(one_of(units))
        ->type_name(choice_list(units));
    command
        .add_option(
            "--deviation", options->deviation, "CSV file for the distance of each point from the surface")
        ->needs(&out)
        ->type_name("FILE");
    command
        .add_flag("--exact",
                  options->exact,
                  "Take a STEP or IGES face of several patches as one exact surface, without a fit")
        ->needs(&out);
    command.add_flag("--cloud", options->cloud, "Fit points as a cloud, even if they are in rows");
    command.add_flag("--json", options->json, "Print the result as JSON");
    command.callback([&chosen, options] { chosen = [options] { return import_file(*options); }; });
}

} // namespace millwright::app
