#include "app/commands/thesis_command.h"

#include "app/interrupt.h"
#include "app/names.h"
#include "app/outputs.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/grid/grid_file.h"
#include "core/project/strategy_path.h"
#include "core/toolpath/thesis_files.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace millwright::app {

namespace {

constexpr int most_nodes = 1000;

struct PictureOptions {
    std::string project, out;
    int nodes = 20;
    kinematics::RotaryTilt constants = kinematics::listing_values;
    bool with_faults = false;
};

int write_pictures(const PictureOptions& options) {
    const OpenedProject opened = open_project(options.project);
    const auto n = static_cast<std::size_t>(opened.project.surface.machined_patch);
    const geometry::BezierPatch patch(opened.project.surface.patches.at(n));
    const auto faults =
        options.with_faults ? toolpath::ListingFaults::all : toolpath::ListingFaults::corrected;
    make_folder(options.out);
    write_outputs(options.out,
                  {{"Surface.dat", toolpath::surface_dat(patch, options.nodes)},
                   {"Toolpath.dat", toolpath::toolpath_dat(patch, options.constants, options.nodes, faults)}},
                  opened.file);
    fmt::print("{0}/Surface.dat\n{0}/Toolpath.dat\n", options.out);
    return 0;
}

enum class Form { pairs, blocks };
const std::map<std::string, Form> forms{{"pairs", Form::pairs}, {"blocks", Form::blocks}};

std::string grid_text(const grid::NodeArray& nodes, Form form) {
    return form == Form::pairs ? grid::pairs_text(nodes) : grid::blocks_text(nodes);
}

struct GridOptions {
    std::string project, out;
    Form form = Form::blocks;
};

int write_grid(const GridOptions& options) {
    const Interrupt interrupt;
    const OpenedProject opened = open_project(options.project);
    const project::Plan plan = planned(opened, project::Scope::program, interrupt.token());
    const grid::Grid& grid = plan.evaluation(project::program_grid(opened.project))->outcome.grid;
    write_file(options.out, grid_text(grid.array(), options.form));
    fmt::print("{}: {} x {} nodes, u and v from 0 to 1\n", options.out, grid.nu(), grid.nv());
    return 0;
}

struct ConvertOptions {
    std::string file, out;
    Form to = Form::blocks;
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
        "files", "Surface.dat and Toolpath.dat of a project's surface, as the listing makes them");
    command.add_option("PROJECT", options->project, "Project file")->required();
    command.add_option("--out", options->out, "Folder for both")->required()->type_name("DIR");
    command.add_option("--nodes", options->nodes, "Points each way")
        ->check(CLI::Range(2, most_nodes))
        ->capture_default_str();
    const auto constants = std::make_shared<const std::map<std::string, const kinematics::RotaryTilt*>>(
        std::map<std::string, const kinematics::RotaryTilt*>{{"listing", &kinematics::listing_values},
                                                             {"chapter-3", &kinematics::chapter_3_values},
                                                             {"gui", &kinematics::gui_values}});
    std::vector<std::string> names;
    for (const auto& [name, values] : *constants) {
        names.push_back(name);
    }
    command
        .add_option_function<std::string>(
            "--constants",
            [options, constants](const std::string& name) { options->constants = *constants->at(name); },
            "Whose machine constants and place of the part (default: listing)")
        ->check(CLI::IsMember(names));
    command.add_flag("--listing-faults",
                     options->with_faults,
                     "With the listing's wrong parenthesis and integer absolute value");
    command.callback([&chosen, options] { chosen = [options] { return write_pictures(*options); }; });
}

void add_grid(CLI::App& thesis, Command& chosen) {
    const auto options = std::make_shared<GridOptions>();
    CLI::App& command = *thesis.add_subcommand(
        "grid", "The grid that the program of a project uses, for the thesis's solver");
    command.add_option("PROJECT", options->project, "Project file")->required();
    command.add_option("--out", options->out, "File to write")->required()->type_name("FILE");
    command.add_option("--form", options->form, "A node a line, or blocks of u and of v (default)")
        ->transform(one_of(forms))
        ->type_name(listed(forms));
    command.callback([&chosen, options] { chosen = [options] { return write_grid(*options); }; });
}

void add_convert(CLI::App& thesis, Command& chosen) {
    const auto options = std::make_shared<ConvertOptions>();
    CLI::App& command = *thesis.add_subcommand(
        "convert",
        "Read a grid or residuals of the thesis's solver, check them, write them in the other form");
    command.add_option("FILE", options->file, "Blocks, or pairs with --size")->required();
    command.add_option("--out", options->out, "File to write")->required()->type_name("FILE");
    command.add_option("--to", options->to, "A node a line, or blocks (default)")
        ->transform(one_of(forms))
        ->type_name(listed(forms));
    CLI::Option& size =
        *command.add_option("--size", options->size, "FILE has pairs, of so many rows and columns")
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
    add_grid(thesis, chosen);
    add_convert(thesis, chosen);
}

} // namespace millwright::app
