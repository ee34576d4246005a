#include "core/project/project_file.h"

#include "core/base/error.h"
#include "core/base/file_format.h"
#include "core/base/files.h"
#include "core/base/numbers.h"
#include "core/geometry/presets.h"
#include "core/project/internal/arm_json.h"
#include "core/project/internal/elliptic_json.h"
#include "core/project/internal/part_size.h"
#include "core/project/internal/plot_json.h"
#include "core/project/internal/setting_json.h"
#include "core/project/json_text.h"
#include "core/project/setting_tables.h"
#include "core/project/tool_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace millwright::project {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view project_format_name = "millwright-project";
constexpr int project_format_version = 1;

Vec3 point(const JsonValue& value) {
    const auto items = value.items(3);
    Vec3 p;
    for (std::size_t n = 0; n < 3; ++n) {
        p[static_cast<Eigen::Index>(n)] = items[n].number(-farthest_point_mm, farthest_point_mm);
    }
    return p;
}

/// The elements of a list of equally long lists, row by row.
std::vector<std::vector<JsonValue>> rows_of_table(const JsonValue& value,
                                                  std::size_t most = geometry::max_degree + 1) {
    std::vector<std::vector<JsonValue>> rows;
    for (const JsonValue& row : value.items()) {
        rows.push_back(rows.empty() ? row.items() : row.items(rows.front().size()));
    }
    if (rows.size() < 2 || rows.size() > most || rows.front().size() < 2 || rows.front().size() > most) {
        value.fail(fmt::format("a control net needs 2 to {} rows and columns", most));
    }
    return rows;
}

geometry::Trim trim(const JsonValue& value) {
    constexpr std::size_t fewest_corners = 3;
    geometry::Trim result;
    std::size_t corners = 0;
    for (const JsonValue& loop : value.items()) {
        geometry::Trim::Loop& read = result.loops.emplace_back();
        for (const JsonValue& corner : loop.items()) {
            const auto uv = corner.items(2);
            read.emplace_back(uv[0].number(0.0, 1.0), uv[1].number(0.0, 1.0));
        }
        corners += read.size();
        if (read.size() < fewest_corners) {
            loop.fail("an outline needs at least three corners");
        }
    }
    if (result.loops.size() > geometry::most_trim_loops || corners > geometry::most_trim_corners) {
        value.fail(fmt::format("outlines can have at most {} loops and {} corners",
                               geometry::most_trim_loops,
                               geometry::most_trim_corners));
    }
    return result;
}

/// The `points` and `weights` of `value` into `result`, a net of any kind, of at most so many rows and
/// columns.
template <class Net> void read_net(const JsonValue& value, Net& result, std::size_t most) {
    const auto points = rows_of_table(value.at("points"), most);
    const int rows = static_cast<int>(points.size());
    const int columns = static_cast<int>(points.front().size());
    result.rows = rows;
    result.columns = columns;
    const auto count = static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
    result.points.assign(count, Vec3::Zero());
    result.weights.assign(count, 1.0);
    const auto weights = value.find("weights");
    const auto weight_rows = weights ? rows_of_table(*weights, most) : std::vector<std::vector<JsonValue>>{};
    if (weights &&
        (weight_rows.size() != points.size() || weight_rows.front().size() != points.front().size())) {
        weights->fail(fmt::format("expected {} x {} weights, one per point", rows, columns));
    }
    constexpr double largest_weight = 1e6;
    for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < columns; ++j) {
            const auto row = static_cast<std::size_t>(i);
            const auto column = static_cast<std::size_t>(j);
            result.points[result.index(i, j)] = point(points[row][column]);
            if (weights) {
                result.weights[result.index(i, j)] =
                    weight_rows[row][column].number(1.0 / largest_weight, largest_weight);
            }
        }
    }
}

geometry::ControlNet net(const JsonValue& value) {
    value.expect_only({"points", "weights", "trim"});
    geometry::ControlNet result;
    read_net(value, result, geometry::max_degree + 1);
    return result;
}

std::vector<double> knots(const JsonValue& value) {
    std::vector<double> result;
    for (const JsonValue& knot : value.items()) {
        result.push_back(knot.number(0.0, 1.0));
    }
    return result;
}

FaceInput face(const JsonValue& value) {
    value.expect_only({"degree", "knots_u", "knots_v", "points", "weights", "trim"});
    FaceInput result;
    const auto degree = value.at("degree").items(2);
    result.net.degree_u = degree[0].integer(1, geometry::max_bspline_degree);
    result.net.degree_v = degree[1].integer(1, geometry::max_bspline_degree);
    result.net.knots_u = knots(value.at("knots_u"));
    result.net.knots_v = knots(value.at("knots_v"));
    read_net(value, result.net, geometry::most_bspline_points);
    if (const std::string fault = geometry::fault_of(result.net); !fault.empty()) {
        value.fail(fault);
    }
    const double size = size_of(result.net.points);
    if (const std::string fault = fault_of_size(size); !fault.empty()) {
        value.fail("the part " + fault, question_of_unit(size));
    }
    if (const auto outline = value.find("trim")) {
        result.trim = trim(*outline);
    }
    return result;
}

void read_preset(const JsonValue& value, SurfaceInput& surface) {
    surface.preset = value.text();
    try {
        surface.patches = project_from_preset(surface.preset).surface.patches;
    } catch (const Error& unknown) {
        value.fail(unknown.diagnostic().message, unknown.diagnostic().hint);
    }
}

void expect_size(const JsonValue& machined, const SurfaceInput& surface) {
    const double size = size_of(surface.patches[static_cast<std::size_t>(surface.machined_patch)].points);
    if (const std::string fault = fault_of_size(size); !fault.empty()) {
        machined.fail("the part " + fault, question_of_unit(size));
    }
}

SurfaceInput read_surface(const JsonValue& value) {
    SurfaceInput result;
    if (const auto exact = value.find("face")) {
        value.expect_only({"face", "flipped"});
        result.face = face(*exact);
        read_flag(value, "flipped", result.flipped);
        return result;
    }
    value.expect_only({"preset", "patches", "machined_patch", "flipped"});
    if (const auto preset = value.find("preset")) {
        read_preset(*preset, result);
    }
    if (const auto patches = value.find("patches")) {
        result.patches.clear();
        for (const JsonValue& patch : patches->items()) {
            result.patches.push_back(net(patch));
            if (const auto outline = patch.find("trim")) {
                result.trims.resize(result.patches.size() - 1);
                result.trims.push_back(trim(*outline));
            }
        }
    }
    if (result.patches.empty()) {
        value.fail("a surface needs a \"preset\" or at least one patch in \"patches\"");
    }
    if (const auto machined = value.find("machined_patch")) {
        result.machined_patch = machined->integer(0, static_cast<int>(result.patches.size()) - 1);
    }
    if (const auto patches = value.find("patches")) {
        expect_size(patches->items()[static_cast<std::size_t>(result.machined_patch)], result);
    }
    read_flag(value, "flipped", result.flipped);
    return result;
}

/// All four, since those that are missing would be of another machine.
ToolSetInput tool_set_of(const JsonValue& value) {
    expect_fields<ToolSetInput>(value, tool_set_numbers(), {});
    ToolSetInput result;
    for (const NumberSetting<ToolSetInput>& number : tool_set_numbers()) {
        number.set(result, value.at(number.id).number(number.min, number.max));
    }
    return result;
}

MachineInput read_machine(const JsonValue& value) {
    value.expect_only({"file", "workpiece_offset", "tool_set", "angle_mode"});
    MachineInput result;
    result.file = value.at("file").text();
    if (result.file.empty()) {
        value.at("file").fail("no machine is specified");
    }
    if (const auto offset = value.find("workpiece_offset")) {
        result.workpiece_offset = point(*offset);
    }
    if (const auto set = value.find("tool_set")) {
        result.tool_set = tool_set_of(*set);
    }
    read_choice(value, "angle_mode", angle_modes(), result.angle_mode);
    return result;
}

TracksInput tracks(const JsonValue& value) {
    expect_fields<TracksInput>(value, tracks_numbers(), {});
    TracksInput result;
    read_numbers<TracksInput>(value, tracks_numbers(), result);
    return result;
}

ChainInput chain(const JsonValue& value) {
    expect_fields<ChainInput>(value, chain_numbers(), {});
    ChainInput result;
    read_numbers<ChainInput>(value, chain_numbers(), result);
    return result;
}

RedistributionInput redistribution(const JsonValue& value) {
    expect_fields<RedistributionInput>(value, redistribution_numbers(), {});
    RedistributionInput result;
    read_numbers<RedistributionInput>(value, redistribution_numbers(), result);
    return result;
}

GridInput grid_input(const JsonValue& value) {
    expect_fields<GridInput>(
        value, grid_numbers(), {"direction", "method", "redistribution", "elliptic", "tracks", "chain"});
    GridInput result;
    read_numbers<GridInput>(value, grid_numbers(), result);
    read_choice(value, "direction", track_directions(), result.direction);
    read_choice(value, "method", grid_methods(), result.method);
    if (const auto settings = value.find("redistribution")) {
        result.redistribution = redistribution(*settings);
    }
    if (const auto settings = value.find("elliptic")) {
        result.elliptic = elliptic_of(*settings);
        if (result.method == GridMethod::elliptic && names_harmonic_solver(*settings)) {
            result.method = GridMethod::harmonic;
        }
    }
    if (const auto settings = value.find("tracks")) {
        result.tracks = tracks(*settings);
    }
    if (const auto settings = value.find("chain")) {
        result.chain = chain(*settings);
    }
    return result;
}

ToolpathInput toolpath_input(const JsonValue& value) {
    expect_fields<ToolpathInput>(value, toolpath_numbers(), {"strategy"});
    ToolpathInput result;
    read_numbers<ToolpathInput>(value, toolpath_numbers(), result);
    read_choice(value, "strategy", strategies(), result.strategy);
    return result;
}

SequencingInput sequencing(const JsonValue& value) {
    expect_fields<SequencingInput>(value, sequencing_numbers(), {"goal"});
    SequencingInput result;
    read_numbers<SequencingInput>(value, sequencing_numbers(), result);
    read_choice(value, "goal", sequencing_goals(), result.goal);
    return result;
}

ProgramInput read_program(const JsonValue& value) {
    expect_fields<ProgramInput>(value, program_numbers(), {"link"});
    ProgramInput result;
    read_numbers<ProgramInput>(value, program_numbers(), result);
    read_choice(value, "link", links(), result.link);
    return result;
}

/// A name in a project file means a file beside it.
fs::path from_folder(const fs::path& file, const fs::path& folder) {
    return file.empty() ? file : (folder / file).lexically_normal();
}

/// What lies in the folder or below it is called from there, so that both can move together.
fs::path to_folder(const fs::path& file, const fs::path& folder) {
    if (file.empty()) { // which would be "." in the current folder
        return file;
    }
    const fs::path from_there = file.lexically_relative(folder);
    return from_there.empty() || *from_there.begin() == ".." ? file : from_there;
}

Project project(const JsonValue& root, const fs::path& folder) {
    expect_format(root, project_format_name, "a project file");
    root.expect_only({"format",
                      "version",
                      "name",
                      "surface",
                      "machine",
                      "tool",
                      "grid",
                      "toolpath",
                      "sequencing",
                      "program",
                      "plot",
                      "arm",
                      "processor"});
    (void)root.at("version").integer(project_format_version, project_format_version);
    Project result;
    result.name = root.at("name").text();
    result.surface = read_surface(root.at("surface"));
    result.machine = read_machine(root.at("machine"));
    if (const auto value = root.find("tool")) {
        result.tool = tool_from(*value);
    }
    if (const auto value = root.find("grid")) {
        result.grid = grid_input(*value);
    }
    if (const auto value = root.find("toolpath")) {
        result.toolpath = toolpath_input(*value);
    }
    if (const auto value = root.find("sequencing")) {
        result.sequencing = sequencing(*value);
    }
    if (const auto value = root.find("program")) {
        result.program = read_program(*value);
    }
    if (const auto value = root.find("plot")) {
        result.plot = plot_of(*value);
        result.plot.file = from_folder(result.plot.file, folder);
    }
    if (const auto value = root.find("processor")) {
        value->expect_only({"assembler", "microprogram"});
        result.processor = {value->at("assembler").text(), value->at("microprogram").text()};
    }
    if (const auto value = root.find("arm")) {
        result.arm = arm_of(*value);
    }
    return result;
}

template <class Net, class Of> Json table_of(const Net& net, Of of) {
    Json rows = Json::array();
    for (int i = 0; i < net.rows; ++i) {
        Json row = Json::array();
        for (int j = 0; j < net.columns; ++j) {
            row.push_back(of(i, j));
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

template <class Net> void add_net(Json& json, const Net& net) {
    json["points"] = table_of(net, [&](int i, int j) { return point_json(net.points[net.index(i, j)]); });
    const auto is_one = [](double weight) { return exactly_equal(weight, 1.0); };
    if (!std::all_of(net.weights.begin(), net.weights.end(), is_one)) {
        json["weights"] = table_of(net, [&](int i, int j) { return net.weights[net.index(i, j)]; });
    }
}

Json net_json(const geometry::ControlNet& net) {
    Json json;
    add_net(json, net);
    return json;
}

Json trim_json(const geometry::Trim& trim) {
    Json loops = Json::array();
    for (const geometry::Trim::Loop& loop : trim.loops) {
        Json corners = Json::array();
        for (const Vec2& corner : loop) {
            corners.push_back(Json::array({corner.x(), corner.y()}));
        }
        loops.push_back(std::move(corners));
    }
    return loops;
}

Json face_json(const FaceInput& face) {
    Json json;
    json["degree"] = Json::array({face.net.degree_u, face.net.degree_v});
    json["knots_u"] = face.net.knots_u;
    json["knots_v"] = face.net.knots_v;
    add_net(json, face.net);
    if (!face.trim.everything()) {
        json["trim"] = trim_json(face.trim);
    }
    return json;
}

Json surface_input_json(const SurfaceInput& surface) {
    Json json;
    if (surface.face) {
        json["face"] = face_json(*surface.face);
        json["flipped"] = surface.flipped;
        return json;
    }
    if (!surface.preset.empty()) {
        json["preset"] = surface.preset;
    }
    json["patches"] = Json::array();
    for (const geometry::ControlNet& net : surface.patches) {
        json["patches"].push_back(net_json(net));
        const std::size_t n = json["patches"].size() - 1;
        if (n < surface.trims.size() && !surface.trims[n].everything()) {
            json["patches"].back()["trim"] = trim_json(surface.trims[n]);
        }
    }
    json["machined_patch"] = surface.machined_patch;
    json["flipped"] = surface.flipped;
    return json;
}

Json machine_input_json(const MachineInput& machine) {
    Json json;
    json["file"] = machine.file;
    if (machine.workpiece_offset) {
        json["workpiece_offset"] = point_json(*machine.workpiece_offset);
    }
    if (machine.tool_set) {
        add_numbers<ToolSetInput>(json["tool_set"], tool_set_numbers(), *machine.tool_set);
    }
    json["angle_mode"] = row_of(angle_modes(), machine.angle_mode).id;
    return json;
}

Json grid_input_json(const GridInput& grid) {
    Json json;
    add_numbers<GridInput>(json, grid_numbers(), grid);
    json["direction"] = row_of(track_directions(), grid.direction).id;
    json["method"] = row_of(grid_methods(), grid.method).id;
    if (!(grid.redistribution == RedistributionInput{})) {
        add_numbers<RedistributionInput>(
            json["redistribution"], redistribution_numbers(), grid.redistribution);
    }
    json["elliptic"] = json_of(grid.elliptic);
    add_numbers<TracksInput>(json["tracks"], tracks_numbers(), grid.tracks);
    add_numbers<ChainInput>(json["chain"], chain_numbers(), grid.chain);
    return json;
}

Json toolpath_input_json(const ToolpathInput& toolpath) {
    Json json;
    json["strategy"] = row_of(strategies(), toolpath.strategy).id;
    add_numbers<ToolpathInput>(json, toolpath_numbers(), toolpath);
    return json;
}

Json sequencing_input_json(const SequencingInput& sequencing) {
    Json json;
    json["goal"] = row_of(sequencing_goals(), sequencing.goal).id;
    add_numbers<SequencingInput>(json, sequencing_numbers(), sequencing);
    return json;
}

Json program_input_json(const ProgramInput& program) {
    Json json;
    add_numbers<ProgramInput>(json, program_numbers(), program);
    json["link"] = row_of(links(), program.link).id;
    return json;
}

} // namespace

Project read_project(const fs::path& file) {
    return project_from_text(read_file(file), file);
}

Project project_from_text(std::string_view text, const fs::path& named) {
    return project(JsonValue::parse(text, named), named.parent_path());
}

std::string project_text(const Project& project) {
    if (const auto faults = faults_of(project); !faults.empty()) {
        throw Error(faults.front());
    }
    Json json;
    json["format"] = project_format_name;
    json["version"] = project_format_version;
    json["name"] = project.name;
    json["surface"] = surface_input_json(project.surface);
    json["machine"] = machine_input_json(project.machine);
    if (!(project.tool == ToolInput{})) {
        json["tool"] = json_of(project.tool);
    }
    json["grid"] = grid_input_json(project.grid);
    if (!(project.toolpath == ToolpathInput{})) {
        json["toolpath"] = toolpath_input_json(project.toolpath);
    }
    if (!(project.sequencing == SequencingInput{})) {
        json["sequencing"] = sequencing_input_json(project.sequencing);
    }
    json["program"] = program_input_json(project.program);
    if (!(project.plot == PlotInput{})) {
        json["plot"] = json_of(project.plot);
    }
    if (!(project.arm == ArmInput{})) {
        json["arm"] = json_of(project.arm);
    }
    if (!(project.processor == ProcessorInput{})) {
        json["processor"] = {{"assembler", project.processor.assembler},
                             {"microprogram", project.processor.microprogram}};
    }
    return json_text(json);
}

std::string write_project(const Project& project, const fs::path& file) {
    Project near = project;
    near.plot.file = to_folder(project.plot.file, file.parent_path());
    std::string text = project_text(near);
    write_file(file, text);
    return text;
}

} // namespace millwright::project
