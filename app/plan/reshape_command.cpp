#include "app/plan/reshape_command.h"

#include "app/command_line/option_values.h"
#include "core/base/error.h"
#include "core/project/project_file.h"
#include "core/project/reshaped_surface.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace millwright::app {

namespace {

using geometry::Parameter;

struct ReshapeOptions {
    std::string project, out;
    std::optional<int> patch;
    std::vector<int> degree; ///< along u, v; empty: as it is
    std::optional<double> split_u, split_v;
    std::vector<double> turn; ///< degrees about X, Y, Z; empty: as it is
};

int reshape(const ReshapeOptions& options) {
    if (options.degree.empty() && !options.split_u && !options.split_v && options.turn.empty()) {
        throw UsageError("nothing to change", {}, "give --degree, --split-u, --split-v or --turn");
    }
    project::Project project = open_project(options.project).project;
    project::SurfaceInput& surface = project.surface;
    const int patch = options.patch.value_or(surface.machined_patch);
    const bool had_region = !project.grid.elliptic.region.everywhere();
    if (!options.degree.empty()) {
        surface = project::with_degrees(surface, patch, options.degree[0], options.degree[1]);
    }
    if (options.split_u) {
        project = project::with_split(std::move(project), patch, Parameter::u, *options.split_u);
    }
    if (options.split_v) {
        project = project::with_split(std::move(project), patch, Parameter::v, *options.split_v);
    }
    if (!options.turn.empty()) {
        surface = project::with_turn(surface, {options.turn[0], options.turn[1], options.turn[2]});
    }
    if (had_region && project.grid.elliptic.region.everywhere()) {
        fmt::print("note: the region of adaptation is on the other part: the grid adapts everywhere\n");
    }
    project::write_project(project, options.out);
    for (std::size_t n = 0; n < surface.patches.size(); ++n) {
        const geometry::ControlNet& net = surface.patches[n];
        fmt::print("patch {}: degree {} x {}{}\n",
                   n,
                   net.rows - 1,
                   net.columns - 1,
                   static_cast<int>(n) == surface.machined_patch ? ", machined" : "");
    }
    return 0;
}

} // namespace

void add_reshape_command(CLI::App& app, Command& chosen) {
    const auto options = std::make_shared<ReshapeOptions>();
    CLI::App& command = *app.add_subcommand("reshape",
                                            "Change the control points of a surface (higher degree, two "
                                            "patches), or turn the part onto another side");
    command.add_option("PROJECT", options->project, "Project file")->required();
    command.add_option("--out", options->out, "Project file to write")->required()->type_name("PROJECT");
    command.add_option(
        "--patch", options->patch, "Patch number, counted from 0 (default: the machined patch)");
    command.add_option("--degree", options->degree, "Degree along u and v, not below the current one")
        ->delimiter(',')
        ->expected(2)
        ->allow_extra_args(false)
        ->type_name("U,V");
    CLI::Option& u = *command.add_option("--split-u", options->split_u, "Split into two patches at this u");
    command.add_option("--split-v", options->split_v, "Split into two patches at this v")->excludes(&u);
    command
        .add_option(
            "--turn", options->turn, "Turn the part onto another side: about X, then Y, then Z, degrees")
        ->delimiter(',')
        ->expected(3)
        ->allow_extra_args(false)
        ->type_name("A,B,C");
    command.callback([&chosen, options] { chosen = [options] { return reshape(*options); }; });
}

} // namespace millwright::app
