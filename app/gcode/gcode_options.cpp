#include "app/gcode/gcode_options.h"

#include "app/command_line/origin_choice.h"
#include "core/gcode/parameter_file.h"
#include "core/gcode_programs/work_origin.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <filesystem>
#include <string>
#include <system_error>

namespace millwright::app {

namespace {

constexpr double grbl_junction_deviation = 0.01; ///< mm: $11 as Grbl ships
constexpr int grbl_look_ahead = 15;              ///< moves

std::string fault_of_folder(const std::string& text) {
    std::error_code missing;
    if (std::filesystem::is_directory(text, missing)) {
        return {};
    }
    return std::filesystem::exists(text, missing) ? "\"" + text + "\" is a file, but must be a folder"
                                                  : "there is no folder \"" + text + "\"";
}

} // namespace

gcode::ReaderSettings reader_settings(const GcodeOptions& options) {
    gcode::ReaderSettings settings;
    settings.dialect = gcode::dialect_of(options.dialect).value();
    settings.block_delete = options.block_delete;
    settings.grbl_axes = options.axes;
    if (!options.tools.empty()) {
        settings.tools = gcode::read_tool_table(options.tools);
    }
    settings.any_tool = options.tools.empty();
    if (!options.parameters.empty()) {
        settings.parameters = gcode::read_parameter_file(options.parameters);
    }
    settings.subroutine_folders.assign(options.subroutines.begin(), options.subroutines.end());
    if (!options.origin.empty()) {
        gcode::put_origin(settings, origin_from(options.origin));
    }
    return settings;
}

motion::PlannerSettings planner_settings(const GcodeOptions& options) {
    motion::PlannerSettings settings;
    if (options.path_tolerance > 0.0) {
        settings.path = {program::PathMode::continuous, options.path_tolerance};
    }
    const bool is_grbl = options.dialect == "grbl";
    const double deviation = options.junction_deviation.value_or(is_grbl ? grbl_junction_deviation : 0.0);
    if (deviation > 0.0) {
        settings.corner_rule = motion::CornerRule::junction_deviation;
        settings.junction_deviation = deviation;
    }
    settings.look_ahead = options.look_ahead.value_or(is_grbl ? grbl_look_ahead : 0);
    return settings;
}

void add_motion_options(CLI::App& command, const std::shared_ptr<GcodeOptions>& options) {
    constexpr double most_mm = 100.0;
    constexpr int most_blocks = 1'000'000;
    command.add_option("--machine", options->machine, "Shipped machine or machine file")->required();
    add_origin_option(command, options->origin);
    command
        .add_option(
            "--path-tolerance", options->path_tolerance, "Corner tolerance where the program sets none, mm")
        ->check(CLI::Range(0.0, most_mm));
    command.add_option("--junction-deviation", options->junction_deviation, "Junction deviation of Grbl, mm")
        ->check(CLI::Range(0.0, most_mm));
    command.add_option("--look-ahead", options->look_ahead, "Look-ahead of the controller, moves (0: all)")
        ->check(CLI::Range(0, most_blocks));
    command.add_flag("--json", options->json, "Print the result as JSON");
}

CLI::App& add_reader_options(CLI::App& group,
                             const char* name,
                             const char* text,
                             const std::shared_ptr<GcodeOptions>& options) {
    CLI::App& command = *group.add_subcommand(name, text);
    command.add_option("FILE", options->file, "G-code file")->required();
    command.add_option("--dialect", options->dialect, "G-code dialect")
        ->check(CLI::IsMember({"linuxcnc", "grbl"}))
        ->capture_default_str();
    command.add_option("--axes", options->axes, "Axes of a Grbl controller")
        ->type_name("LETTERS")
        ->capture_default_str();
    command.add_option("--tools", options->tools, "LinuxCNC tool table file")->type_name("FILE");
    command.add_option("--parameters", options->parameters, "LinuxCNC parameter file")->type_name("FILE");
    command
        .add_option("--subroutines",
                    options->subroutines,
                    "Folder of subroutine files, searched after the program's own folder")
        ->type_name("FOLDER")
        ->check(CLI::Validator(fault_of_folder, ""))
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command.add_flag("--block-delete", options->block_delete, "Skip lines that begin with / (block delete)");
    return command;
}

} // namespace millwright::app
