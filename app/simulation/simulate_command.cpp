#include "app/simulation/simulate_command.h"

#include "app/command_line/option_values.h"
#include "app/command_line/origin_choice.h"
#include "app/command_line/output_transaction.h"
#include "app/command_line/watched_work.h"
#include "app/simulation/simulated_collisions.h"
#include "app/simulation/simulated_work.h"
#include "app/simulation/simulation_report.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/simulation/cut_mesh.h"
#include "core/simulation/engagement.h"
#include "core/simulation/resolution.h"
#include "ui/render/picture.h"
#include "ui/viewport/solid_picture.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

namespace millwright::app {

namespace {

constexpr std::size_t most_triangles = 400'000;
constexpr render::PixelSize simulation_picture_size{1280, 800};

/// Of the files of a simulation, of which a folder has one set.
constexpr std::string_view simulation_kind = "simulation";

/// Cut faces in the colour of a fresh cut, the stock's own in gray.
std::vector<std::array<std::uint8_t, 3>> mesh_colors(const simulation::CutMesh& mesh) {
    std::vector<std::array<std::uint8_t, 3>> colors;
    colors.reserve(mesh.moves.size());
    constexpr std::array<std::uint8_t, 3> untouched{150, 156, 166}, cut{214, 178, 110};
    for (const std::int32_t move : mesh.moves) {
        colors.push_back(move == simulation::stock_surface ? untouched : cut);
    }
    return colors;
}

/// Puts the picture `name` into `set`; where there is no OpenGL an older one is taken away.
void add_picture(OutputSet& set, const std::string& name, const viewport::ColoredSolid& solid) {
    try {
        set.files.push_back(
            {name,
             render::to_png(viewport::solid_picture(solid, simulation_picture_size, render::Theme::light))});
    } catch (const Error& error) {
        fmt::print(stderr, "warning: no {}: {}\n", name, to_text(error.diagnostic()));
        set.absent.push_back(name);
    }
}

void add_part(OutputSet& set, const plan::PartSurface& part, const ComparedPart& compared) {
    const auto colors = plan::deviation_colors(part, compared.deviations, compared.tolerance);
    set.files.push_back({"part.ply", simulation::ply_of(part.corners, part.triangles, colors)});
    add_picture(
        set,
        "part.png",
        {.points = part.corners, .triangles = part.triangles, .colors = colors, .closed = part.closed});
}

/// Lines of the program in place of none.
template <class Work> auto with_place(const SimulatedWork& work, const Work& body) {
    try {
        return body();
    } catch (const Error& error) {
        Diagnostic diagnostic = error.diagnostic();
        if (diagnostic.place.line > 0 && diagnostic.place.file.empty()) {
            diagnostic.place.file = work.program_file;
        }
        throw Error(std::move(diagnostic));
    }
}

std::optional<ComparedPart> compared_part(const SimulatedWork& work,
                                          const simulation::SimulationInput& input,
                                          const simulation::Simulation& found,
                                          double tolerance,
                                          const Progress& progress) {
    if (!work.part) {
        return std::nullopt;
    }
    progress.report(0.0, "Comparing with the part");
    ComparedPart compared{.deviations = simulation::deviations(input, found, work.part->points, progress),
                          .summary = {},
                          .tolerance = tolerance};
    compared.summary = simulation::summary_of(work.part->points, compared.deviations, tolerance);
    return compared;
}

simulation::SimulationInput input_of(const SimulatedWork& work, const SimulateOptions& options) {
    const std::size_t most_bytes = simulation::field_memory(options.memory_mb);
    const double usual = simulation::usual_resolution(simulation::bounds(work.stock), most_bytes);
    return {.program = work.program,
            .machine = work.machine,
            .tools = work.tools,
            .stock = work.stock,
            .resolution = options.resolution.value_or(usual),
            .most_bytes = most_bytes};
}

int simulate(const SimulateOptions& options) {
    const Interrupt interrupt;
    expect_inputs_kept(options.out,
                       {"simulation.json",
                        "engagement.csv",
                        "cut.stl",
                        "cut.ply",
                        "cut.png",
                        "part.ply",
                        "part.png",
                        "program.ngc"},
                       simulation_kind,
                       input_files(options));
    const OutputFolder folder(options.out);
    const SimulatedWork work = simulated_work(options, interrupt.token());
    ProgressPrinter printer;
    const Progress progress([&](const Progress::Report& report) { printer.show(report); }, interrupt.token());
    const auto begin = std::chrono::steady_clock::now();
    const simulation::SimulationInput input = input_of(work, options);
    progress.report(0.0, "Cutting");
    const simulation::Simulation found =
        with_place(work, [&] { return simulation::simulate(input, progress.part(0.0, 0.7)); });
    const std::optional<ComparedPart> compared =
        compared_part(work, input, found, options.tolerance, progress.part(0.7, 0.8));
    progress.report(0.8, "Looking for collisions");
    const simulation::CollisionReport collisions =
        collisions_of(work, options, input, found, progress.part(0.8, 0.9));
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    progress.report(0.9, "Making the mesh");
    const simulation::CutMesh mesh =
        simulation::mesh_of(*found.field, most_triangles, progress.part(0.9, 1.0));
    printer.finish();
    const SimulationCost cost{took.count(), thread_count()};
    const auto colors = mesh_colors(mesh);
    OutputSet set{{{"simulation.json",
                    simulation_report_text(work, found, mesh, compared, collisions, options.clearance, cost)},
                   {"engagement.csv", simulation::csv_of(simulation::engagements(work.program, found))},
                   {"cut.stl", simulation::stl_of(mesh)},
                   {"cut.ply", simulation::ply_of(mesh.points, mesh.triangles, colors)}},
                  {},
                  std::string(simulation_kind)};
    if (!work.program_text.empty()) {
        set.files.push_back({"program.ngc", work.program_text});
    }
    if (!mesh.points.empty()) {
        add_picture(set, "cut.png", {.points = mesh.points, .triangles = mesh.triangles, .colors = colors});
    } else {
        set.absent.emplace_back("cut.png");
    }
    if (compared) {
        add_part(set, *work.part, *compared);
    }
    write_outputs(options.out, set, options.file);
    print_simulation(work, found, compared, collisions, cost);
    const bool gouged = compared && compared->summary.gouged > 0.0;
    const bool complete = !found.skipped || found.skipped->feeds == 0;
    const bool free = rapid_count(found) == 0 && !collides(collisions, found);
    return free && !gouged && complete ? 0 : 1;
}

void add_work_options(CLI::App& command, SimulateOptions& options) {
    command.add_option("FILE", options.file, "Project, or G-code file")->required();
    command.add_option("--machine", options.machine, "Shipped machine or machine file, for a G-code file")
        ->type_name("NAME|FILE");
    command
        .add_option("--stock",
                    options.stock,
                    "box:LX,LY,LZ[@X,Y,Z], cylinder:D,L[,x|y|z][@X,Y,Z], tube:D,BORE,L[,x|y|z][@X,Y,Z] or "
                    "FILE.stl[@X,Y,Z] (default for a project: its own stock)")
        ->type_name("SPEC");
}

void add_tool_options(CLI::App& command, SimulateOptions& options) {
    command
        .add_option(
            "--tool",
            options.tools,
            "flat:D, ball:D, bull:D:R, v:ANGLE:D[:TIP|:rR], drill:D[:ANGLE], each with :lLENGTH, or a "
            "tool file; N=SPEC sets the tool of T N (repeatable)")
        ->type_name("[N=]SPEC")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command
        .add_option("--flutes",
                    options.flutes,
                    "Cutting length of the tool, mm; above it is shank, which does not cut (repeatable)")
        ->type_name("[N=]MM")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command
        .add_option(
            "--fixture", options.fixtures, "Mesh of a fixture on the table, mm, moved by X,Y,Z (repeatable)")
        ->type_name("FILE[@X,Y,Z]")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command
        .add_option("--clearance",
                    options.clearance,
                    "Bodies that come nearer than this without touching are listed as near misses, mm")
        ->type_name("MM")
        ->check(not_below_zero());
}

void add_field_options(CLI::App& command, SimulateOptions& options) {
    command
        .add_option("--resolution",
                    options.resolution,
                    "Spacing of the dexel lines, mm (default: longest stock edge / 400)")
        ->type_name("MM")
        ->check(above_zero());
    command
        .add_option("--part",
                    options.part,
                    "Mesh of the part to compare with, mm (default for a project: the machined face)")
        ->type_name("FILE");
    command.add_option("--tolerance", options.tolerance, "Tolerance of the comparison, mm")
        ->type_name("MM")
        ->check(not_below_zero());
    command.add_option("--memory", options.memory_mb, "Memory limit of the dexel field, MB")
        ->type_name("MB")
        ->check(above_zero());
}

void add_reading_options(CLI::App& command, SimulateOptions& options) {
    add_origin_option(command, options.origin);
    command.add_option("--dialect", options.dialect, "G-code dialect")
        ->check(CLI::IsMember({"linuxcnc", "grbl"}))
        ->default_str("linuxcnc");
    command
        .add_option("--subroutines",
                    options.subroutines,
                    "Folder of subroutine files, searched after the program's own")
        ->type_name("FOLDER")
        ->check(CLI::ExistingDirectory)
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command.add_flag("--block-delete", options.block_delete, "Skip lines that begin with / (block delete)");
}

} // namespace

void add_simulate_command(CLI::App& app, Command& chosen) {
    const auto options = std::make_shared<SimulateOptions>();
    CLI::App& command = *app.add_subcommand(
        "simulate",
        "Simulate material removal: remaining stock, gouges, collisions, and rapid moves through material");
    add_work_options(command, *options);
    add_tool_options(command, *options);
    add_field_options(command, *options);
    add_reading_options(command, *options);
    command
        .add_option("--out",
                    options->out,
                    "Folder for simulation.json, engagement.csv, cut.stl, cut.ply, cut.png, and part.ply and "
                    "part.png of a "
                    "comparison")
        ->required()
        ->type_name("DIR");
    command.callback([&chosen, options] { chosen = [options] { return simulate(*options); }; });
}

} // namespace millwright::app
