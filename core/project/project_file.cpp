#include "core/project/project_file.h"

#include "core/base/error.h"
#include "core/base/file_format.h"
#include "core/base/files.h"
#include "core/project/internal/arm_json.h"
#include "core/project/internal/elliptic_json.h"
#include "core/project/internal/plot_json.h"
#include "core/project/internal/setting_json.h"
#include "core/project/internal/surface_json.h"
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
        result.workpiece_offset = point_of(*offset);
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

StockInput stock_of(const JsonValue& value) {
    value.expect_only({"around_part", "allowance_mm", "shape", "file", "position"});
    StockInput stock;
    read_flag(value, "around_part", stock.around_part);
    if (const auto allowance = value.find("allowance_mm")) {
        stock.allowance_mm = allowance->number(0.0, largest_allowance_mm);
    }
    if (const auto shape = value.find("shape")) {
        stock.shape = shape->text();
        if (stock.shape.empty()) {
            shape->fail("no stock is named",
                        "write a box, cylinder or tube, such as box:100,100,20@-50,-50,-20");
        }
    }
    if (const auto file = value.find("file")) {
        stock.file = file->text();
        if (stock.file.empty()) {
            file->fail("the name is empty", "leave \"file\" out for a stock without a mesh");
        }
    }
    if (const auto position = value.find("position")) {
        stock.position = point_of(*position);
    }
    return stock;
}

/// A name in a project file means a file beside it.
fs::path from_folder(const fs::path& file, const fs::path& folder) {
    return file.empty() ? file : (folder / file).lexically_normal();
}

/// From a folder that may be empty, which is the current one.
fs::path absolute_of(const fs::path& path) {
    return (fs::current_path() / path).lexically_normal();
}

/// What lies in the folder or below it is called from there, so that both can move together; so is what was
/// called from the current folder, which the reader of the file does not know.
fs::path to_folder(const fs::path& file, const fs::path& folder) {
    if (file.empty()) { // which would be "." in the current folder
        return file;
    }
    const fs::path from_there = file.lexically_relative(folder);
    if (!from_there.empty() && *from_there.begin() != "..") {
        return from_there;
    }
    return file.is_absolute() ? file : absolute_of(file).lexically_relative(absolute_of(folder));
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
                      "stock",
                      "plot",
                      "arm",
                      "processor"});
    (void)root.at("version").integer(project_format_version, project_format_version);
    Project result;
    result.name = root.at("name").text();
    result.surface = surface_input_of(root.at("surface"));
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
    if (const auto value = root.find("stock")) {
        result.stock = stock_of(*value);
        result.stock.file = from_folder(result.stock.file, folder);
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

Json stock_json(const StockInput& stock) {
    Json json;
    json["around_part"] = stock.around_part;
    json["allowance_mm"] = stock.allowance_mm;
    json["shape"] = stock.shape;
    if (!stock.file.empty()) {
        json["file"] = stock.file.generic_string();
    }
    if (stock.position != Vec3::Zero()) {
        json["position"] = point_json(stock.position);
    }
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
    json["surface"] = json_of(project.surface);
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
    if (!(project.stock == StockInput{})) {
        json["stock"] = stock_json(project.stock);
    }
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
    near.stock.file = to_folder(project.stock.file, file.parent_path());
    std::string text = project_text(near);
    write_file(file, text);
    return text;
}

} // namespace millwright::project
