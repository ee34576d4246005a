#include "app/plan/thesis_command.h"

#include "app/command_line/option_values.h"
#include "app/command_line/output_transaction.h"
#include "app/plan/thesis_form.h"
#include "app/plan/thesis_grid.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/kinematics/rotary_tilt.h"
#include "core/project/setting_tables.h"
#include "core/project/surface.h"
#include "core/toolpath/thesis_files.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace millwright::app {

namespace {

constexpr int most_nodes = 1000;

struct PictureOptions {
    std::string project, out;
    std::vector<int> nodes; ///< n_u and n_v, or one number for both; empty: the project's
    std::optional<grid::TrackDirection> direction;
    std::optional<kinematics::RotaryTilt> constants; ///< nothing: the project's machine
    bool with_faults = false;
};

toolpath::ListingGrid listing_grid(const PictureOptions& options, const project::Project& project) {
    const project::GridInput& grid = project.grid;
    return {.nu = options.nodes.empty() ? grid.nu : options.nodes.front(),
            .nv = options.nodes.empty() ? grid.nv : options.nodes.back(),
            .direction = options.direction.value_or(grid.direction),
            .flipped = project.surface.flipped};
}

/// By the listing's formulas where the machine is built like the thesis's, else by its own kinematics.
std::vector<Vec3> mid_points(const PictureOptions& options,
                             const OpenedProject& opened,
                             const geometry::ParametricSurface& patch,
                             const toolpath::ListingGrid& grid) {
    const auto faults =
        options.with_faults ? toolpath::ListingFaults::all : toolpath::ListingFaults::corrected;
    if (options.constants) {
        return toolpath::listing_mid_points(patch, *options.constants, grid, faults);
    }
    const kinematics::MachineModel machine = plan::cutting_setup_of(opened.project, opened.folders).machine;
    if (const auto constants = kinematics::rotary_tilt_of(machine)) {
        return toolpath::listing_mid_points(patch, *constants, grid, faults);
    }
    if (options.with_faults) {
        throw UsageError(
            fmt::format("the listing's faults apply only to its own machine, but the project has '{}'",
                        machine.name()),
            {},
            "use its constants: --constants listing");
    }
    return toolpath::machine_mid_points(patch, machine, grid);
}

int write_pictures(const PictureOptions& options) {
    const OpenedProject opened = open_project(options.project);
    const region::Region patch = project::machined_region(opened.project.surface);
    const toolpath::ListingGrid grid = listing_grid(options, opened.project);
    const std::vector<Vec3> middles = mid_points(options, opened, patch, grid);
    make_folder(options.out);
    write_outputs(options.out,
                  {{{"Surface.dat", toolpath::surface_dat(patch, grid)},
                    {"Toolpath.dat", toolpath::toolpath_dat(patch, middles, grid)}}},
                  opened.file);
    fmt::print("{0}/Surface.dat\n{0}/Toolpath.dat\n", options.out);
    return 0;
}

struct ConvertOptions {
    std::string file, out;
    GridForm to = GridForm::blocks;
    std::vector<int> size; ///< rows, columns of pairs; empty: blocks
    bool residuals = false;
};

int convert_grid(const ConvertOptions& options) {
    const std::string text = read_file(options.file);
    const auto contents = options.residuals ? grid::FileContents::residuals : grid::FileContents::nodes;
    const grid::NodeArray nodes =
        options.size.empty() ? grid::parse_blocks(text, options.file, contents)
                             : grid::parse_pairs(text, options.file, options.size[0], options.size[1]);
    write_file(options.out, grid_text(nodes, options.to));
    fmt::print("{}: {} x {} {}\n",
               options.out,
               nodes.rows,
               nodes.columns,
               options.residuals ? "residuals" : "nodes");
    return 0;
}

void add_files(CLI::App& thesis, Command& chosen) {
    const auto options = std::make_shared<PictureOptions>();
    CLI::App& command = *thesis.add_subcommand(
        "files", "Write Surface.dat and Toolpath.dat of a project, as the listing does");
    command.add_option("PROJECT", options->project, "Project file")->required();
    command.add_option("--out", options->out, "Folder for both files")->required()->type_name("DIR");
    command
        .add_option("--nodes",
                    options->nodes,
                    "Points along u and along v, or one number for both (default: the project's)")
        ->delimiter(',')
        ->expected(1, 2)
        ->allow_extra_args(false)
        ->check(CLI::Range(2, most_nodes))
        ->type_name("NU[,NV]");
    std::map<std::string, grid::TrackDirection> track_directions;
    for (const auto& row : project::track_directions()) {
        track_directions.emplace(row.id, row.value);
    }
    command
        .add_option_function<std::string>(
            "--direction",
            [options, track_directions](const std::string& name) {
                options->direction = track_directions.at(name);
            },
            "Tracks along u (Tool Path 1) or along v (Tool Path 2); default: the project's")
        ->check(CLI::IsMember(track_directions).description(""))
        ->type_name(choice_list(track_directions));
    const std::map<std::string, std::optional<kinematics::RotaryTilt>> constants{
        {"project", std::nullopt},
        {"listing", kinematics::listing_values},
        {"chapter-3", kinematics::chapter_3_values},
        {"gui", kinematics::gui_values}};
    command
        .add_option_function<std::string>(
            "--constants",
            [options, constants](const std::string& name) { options->constants = constants.at(name); },
            "Machine and position of the part: the project's (default), or one of the thesis's three sets")
        ->check(CLI::IsMember(constants).description(""))
        ->type_name(choice_list(constants));
    command.add_flag("--listing-faults",
                     options->with_faults,
                     "Reproduce the listing's wrong parenthesis and integer absolute value");
    command.callback([&chosen, options] { chosen = [options] { return write_pictures(*options); }; });
}

void add_convert(CLI::App& thesis, Command& chosen) {
    const auto options = std::make_shared<ConvertOptions>();
    CLI::App& command = *thesis.add_subcommand(
        "convert", "Check a grid or residuals of the thesis's solver and convert them to the other form");
    command.add_option("FILE", options->file, "Blocks, or pairs with --size")->required();
    command.add_option("--out", options->out, "Output file")->required()->type_name("FILE");
    command.add_option("--to", options->to, "One node per line, or blocks")
        ->transform(one_of(grid_forms))
        ->type_name(choice_list(grid_forms))
        ->default_str("blocks");
    CLI::Option& size =
        *command.add_option("--size", options->size, "FILE has pairs, with this number of rows and columns")
             ->delimiter(',')
             ->expected(2)
             ->allow_extra_args(false)
             ->check(CLI::Range(2, most_nodes))
             ->type_name("ROWS,COLUMNS");
    command
        .add_flag("--residuals", options->residuals, "FILE has residuals: any numbers, which are not folded")
        ->excludes(&size);
    command.callback([&chosen, options] { chosen = [options] { return convert_grid(*options); }; });
}

} // namespace

void add_thesis_command(CLI::App& app, Command& chosen) {
    CLI::App& thesis =
        *app.add_subcommand("thesis", "Files of the thesis's own programs, for comparison with the original");
    thesis.require_subcommand(1);
    add_files(thesis, chosen);
    add_thesis_grid(thesis, chosen);
    add_convert(thesis, chosen);
}

} // namespace millwright::app
