#include "app/plan/thesis_grid.h"

#include "app/command_line/option_values.h"
#include "app/command_line/watched_work.h"
#include "app/plan/thesis_form.h"
#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/sentences.h"
#include "core/base/text.h"
#include "core/grid/weight.h"
#include "core/plan/grids.h"
#include "core/plan/strategy_path.h"
#include "core/project/grid_methods/grid_method_row.h"
#include "core/project/setting_tables.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace millwright::app {

namespace {

using project::GridMethod;

/// What the coordinates of a file count.
enum class GridUnits { zero_to_one, node_numbers };
const std::map<std::string, GridUnits> grid_units{{"parameters", GridUnits::zero_to_one},
                                                  {"nodes", GridUnits::node_numbers}};

struct GridOptions {
    std::string project, out, start, residuals, norms;
    std::optional<GridMethod> method; ///< nothing: what the program uses
    GridForm form = GridForm::blocks;
    std::optional<GridForm> start_form; ///< nothing: that of the file
    GridUnits units = GridUnits::zero_to_one;
};

std::string units_text(GridUnits units, int nu, int nv) {
    return units == GridUnits::zero_to_one ? std::string("u and v from 0 to 1")
                                           : fmt::format("x from 0 to {}, y from 0 to {}", nu - 1, nv - 1);
}

void write_nodes(const GridOptions& options, const grid::NodeArray& in_square) {
    const bool counted = options.units == GridUnits::node_numbers;
    write_file(options.out,
               grid_text(counted ? grid::to_solver_coordinates(in_square) : in_square, options.form));
    fmt::print("{}: {} x {} nodes, {}\n",
               options.out,
               in_square.rows,
               in_square.columns,
               units_text(options.units, in_square.rows, in_square.columns));
}

/// The grid that the program follows, which is never worse than the uniform one.
int write_program_grid(const GridOptions& options) {
    const Interrupt interrupt;
    const OpenedProject opened = open_project(options.project);
    const plan::Plan plan = planned(opened, plan::Scope::program, interrupt.token());
    write_nodes(options, plan.grid(plan::program_grid(opened.project)).evaluation->outcome.grid.array());
    return 0;
}

/// Throws Error for what is no such grid.
grid::Grid start_grid(const GridOptions& options, const project::GridInput& input) {
    const bool counted = options.units == GridUnits::node_numbers;
    grid::WantedNodes wanted{.rows = input.nu, .columns = input.nv, .form = options.start_form};
    if (counted) {
        wanted.most = Vec2(input.nu - 1, input.nv - 1);
    } else {
        wanted.hint = "use --units nodes for node numbers from 0 to n - 1";
    }
    grid::NodeArray nodes = grid::parse_nodes(read_file(options.start), options.start, wanted);
    nodes = counted ? grid::to_parameters(nodes) : std::move(nodes);
    if (!(grid::min_corner_jacobian(nodes) > 0.0)) {
        throw Error("a cell is folded at one of its corners", options.start);
    }
    return grid::Grid(std::move(nodes));
}

std::string norms_csv(const std::vector<grid::IterationNorm>& norms) {
    std::string text = "iteration,round,lv,norm\n";
    int iteration = 0;
    for (const grid::IterationNorm& at : norms) {
        text += fmt::format("{},{},{},",
                            ++iteration,
                            at.round,
                            std::isfinite(at.adaptation) ? shortest(at.adaptation) : std::string());
        text += std::isfinite(at.norm) ? fmt::format("{:.9e}\n", at.norm) : "\n";
    }
    return text;
}

std::string mean_text(const grid::ErrorSummary& error) {
    return std::isfinite(error.mean) ? fixed(error.mean, 5) + " mm" : std::string("out of reach");
}

/// Which grid the method takes for its best, beside the one that is written.
std::string kept_text(const grid::OptimiserState& state, const grid::Grid& start) {
    return state.best.array() == state.reached ? "this grid"
           : state.best == start               ? "the start grid"
                                               : "another grid";
}

/// `start` and `written` are measured alike, whatever the method has measured on its way.
void print_ending(const grid::OptimiserState& state,
                  const project::GridInput& input,
                  GridMethod method,
                  const grid::Grid& start,
                  const toolpath::KinematicError& error) {
    const bool solves = !state.norms.empty();
    if (state.iteration > 0) { // else it is done in one go
        fmt::print("{}: {} in {}, norm {:.9e}{}\n",
                   project::row_of(project::grid_methods(), method).label,
                   counted(state.iteration, "iteration"),
                   counted(state.round, "round"),
                   state.norm,
                   solves ? fmt::format(", tolerance {}", shortest(input.elliptic.tolerance))
                          : std::string());
    }
    fmt::print("Smallest cell area {:.6f} (1 in the uniform grid)\n",
               grid::min_cell_area(grid::to_solver_coordinates(state.reached)));
    const auto mean_of = [&](const grid::Grid& grid) {
        return mean_text(grid::summary(grid::measure(error, grid, input.direction, grid::fine)));
    };
    fmt::print("Mean distance to the curve: start {}, this grid {}\n",
               mean_of(start),
               mean_of(grid::Grid(state.reached)));
    fmt::print("The method keeps {}: {}\n", kept_text(state, start), with_full_stop(state.note));
    if (!state.warning.empty()) {
        fmt::print(stderr, "warning: {}\n", state.warning);
    }
}

/// Refuses files that the method does not have before it works.
void expect_files_of(const GridOptions& options, GridMethod method) {
    if (!options.start.empty() && method == GridMethod::uniform) {
        throw UsageError("--start does not apply to --method uniform",
                         {},
                         "leave it out, or choose a method that changes the start grid");
    }
    const bool elliptic = method == GridMethod::elliptic;
    if (!options.residuals.empty() && !elliptic) {
        throw UsageError("--residuals applies only to --method elliptic",
                         {},
                         "leave it out: the other methods solve no equations");
    }
    if (!options.norms.empty() && !elliptic && method != GridMethod::harmonic) {
        throw UsageError("--norms applies only to --method elliptic and harmonic",
                         {},
                         "leave it out: the other methods do not iterate on a norm");
    }
}

grid::OptimiserState adapted(grid::GridOptimiser& optimiser, GridMethod method, const std::stop_token& stop) {
    ProgressPrinter printer;
    const Progress progress([&](const Progress::Report& report) { printer.show(report); }, stop);
    progress.report(0.0, std::string(row_of(method).title));
    return grid::run(optimiser, progress);
}

/// The grid that the method ends with, whether or not it improves the path.
int write_adapted_grid(const GridOptions& options, GridMethod method) {
    expect_files_of(options, method);
    const Interrupt interrupt;
    const OpenedProject opened = open_project(options.project);
    const project::GridInput& input = opened.project.grid;
    if (method == GridMethod::uniform) {
        write_nodes(options, grid::Grid::uniform(input.nu, input.nv).array());
        return 0;
    }
    const std::optional<grid::Grid> start =
        options.start.empty() ? std::nullopt : std::optional(start_grid(options, input));
    const toolpath::KinematicError error =
        plan::cutting_setup_of(opened.project, opened.folders).error_model();
    const auto optimiser = plan::make_optimiser(method, input, error, plan::Effort::full, start);
    const grid::OptimiserState state = adapted(*optimiser, method, interrupt.token());
    if (!options.residuals.empty()) {
        const std::optional<grid::NodeArray> residuals = optimiser->residuals();
        if (!residuals) {
            throw Error(
                "there are no residuals: nothing was iterated, or the grid has fewer than 3 x 3 nodes",
                opened.file);
        }
        write_file(options.residuals, grid::blocks_text(*residuals));
    }
    if (!options.norms.empty()) {
        write_file(options.norms, norms_csv(state.norms));
    }
    write_nodes(options, state.reached);
    print_ending(state, input, method, start.value_or(grid::Grid::uniform(input.nu, input.nv)), error);
    return 0;
}

int write_grid(const GridOptions& options) {
    return options.method ? write_adapted_grid(options, *options.method) : write_program_grid(options);
}

} // namespace

void add_thesis_grid(CLI::App& thesis, Command& chosen) {
    const auto options = std::make_shared<GridOptions>();
    CLI::App& command = *thesis.add_subcommand(
        "grid",
        "Write the grid of a project's program, or the final grid of a method, for the thesis's solver");
    command.add_option("PROJECT", options->project, "Project file")->required();
    command.add_option("--out", options->out, "Output file")->required()->type_name("FILE");
    command.add_option("--form", options->form, "One node per line, or blocks of u and of v")
        ->transform(one_of(grid_forms))
        ->type_name(choice_list(grid_forms))
        ->default_str("blocks");
    command.add_option("--units", options->units, "u and v from 0 to 1, or from 0 to n - 1 as in the thesis")
        ->transform(one_of(grid_units))
        ->type_name(choice_list(grid_units))
        ->default_str("parameters");
    std::map<std::string, GridMethod> methods;
    for (const auto& row : project::grid_methods()) {
        methods.emplace(row.id, row.value);
    }
    CLI::Option& method =
        *command
             .add_option_function<std::string>(
                 "--method",
                 [options, methods](const std::string& name) { options->method = methods.at(name); },
                 "Write the final grid of this method, even if it does not improve the path")
             ->check(CLI::IsMember(methods).description(""))
             ->type_name(choice_list(methods));
    CLI::Option& start =
        *command.add_option("--start", options->start, "Start grid, such as the thesis's file source")
             ->type_name("FILE")
             ->needs(&method);
    command
        .add_option_function<std::string>(
            "--start-form",
            [options](const std::string& name) { options->start_form = grid_forms.at(name); },
            "Form of that file (default: the form that has the nodes of the project)")
        ->check(CLI::IsMember(grid_forms).description(""))
        ->type_name(choice_list(grid_forms))
        ->needs(&start);
    command
        .add_option("--residuals", options->residuals, "Write R_X and R_Y of the last grid, as in orx.dat")
        ->type_name("FILE")
        ->needs(&method);
    command.add_option("--norms", options->norms, "Write the norm of each iteration as CSV")
        ->type_name("FILE")
        ->needs(&method);
    command.callback([&chosen, options] { chosen = [options] { return write_grid(*options); }; });
}

} // namespace millwright::app
