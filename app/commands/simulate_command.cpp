#include "app/commands/simulate_command.h"

#include "app/finite_number.h"
#include "app/interrupt.h"
#include "app/origin_choice.h"
#include "app/outputs.h"
#include "app/progress_printer.h"
#include "app/simulated_work.h"
#include "app/simulation_report.h"
#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/simulation/cut_mesh.h"
#include "ui/render/picture.h"
#include "ui/viewport/solid_picture.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <utility>

namespace millwright::app {

namespace {

constexpr double bytes_in_megabyte = 1e6;
constexpr std::size_t most_triangles = 400'000;
constexpr render::PixelSize simulation_picture_size{1280, 800};

/// So many cells along the longest edge of the stock, where nothing is said.
constexpr double usual_cells = 400.0;

std::size_t most_field_bytes(const SimulateOptions& options) {
    const auto wanted = static_cast<std::size_t>(options.memory_mb * bytes_in_megabyte);
    constexpr std::size_t share = 5; // of the memory that is free four fifths
    const std::optional<std::size_t> free = free_memory();
    return free ? std::min(wanted, *free / share * (share - 1)) : wanted;
}

/// As fine as the memory allows, but no finer than usual.
double resolution_of(const SimulateOptions& options, const simulation::Stock& stock) {
    if (options.resolution) {
        return *options.resolution;
    }
    const Box3 box = simulation::bounds(stock);
    return std::max(box.sizes().maxCoeff() / usual_cells,
                    1.05 * simulation::pitch_within(box, most_field_bytes(options)));
}

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

/// Nothing where there is no OpenGL.
std::optional<std::string> picture_of(const simulation::CutMesh& mesh) {
    try {
        return render::to_png(viewport::solid_picture(
            {.points = mesh.points, .triangles = mesh.triangles, .colors = mesh_colors(mesh)},
            simulation_picture_size,
            render::Theme::light));
    } catch (const Error& error) {
        fmt::print(stderr, "warning: no picture: {}\n", to_text(error.diagnostic()));
        return std::nullopt;
    }
}

int simulate(const SimulateOptions& options) {
    const Interrupt interrupt;
    const OutputFolder folder(options.out);
    SimulatedWork work = simulated_work(options, interrupt.token());
    ProgressPrinter printer;
    const Progress progress([&](const Progress::Report& report) { printer.show(report); }, interrupt.token());
    const auto begin = std::chrono::steady_clock::now();
    progress.report(0.0, "Cutting");
    const auto found = [&] {
        try {
            return simulation::simulate({.program = work.program,
                                         .machine = work.machine,
                                         .tools = work.tools,
                                         .stock = work.stock,
                                         .resolution = resolution_of(options, work.stock),
                                         .most_bytes = most_field_bytes(options)},
                                        progress.part(0.0, 0.9));
        } catch (const Error& error) {
            Diagnostic diagnostic = error.diagnostic();
            if (diagnostic.place.line > 0 && diagnostic.place.file.empty()) {
                diagnostic.place.file = work.program_file;
            }
            throw Error(std::move(diagnostic));
        }
    }();
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    progress.report(0.9, "Making the mesh");
    const simulation::CutMesh mesh =
        simulation::mesh_of(*found.field, most_triangles, progress.part(0.9, 1.0));
    printer.finish();
    const SimulationCost cost{took.count(), thread_count()};
    OutputSet set{{{"simulation.json", simulation_report_text(work, found, mesh, cost)},
                   {"cut.stl", simulation::stl_of(mesh)},
                   {"cut.ply", simulation::ply_of(mesh, mesh_colors(mesh))}},
                  {},
                  "simulation"};
    if (!work.program_text.empty()) {
        set.files.push_back({"program.ngc", work.program_text});
    }
    if (auto picture = picture_of(mesh)) {
        set.files.push_back({"cut.png", std::move(*picture)});
    } else { // an older one would be taken for it
        set.absent.push_back("cut.png");
    }
    write_outputs(options.out, set, options.file);
    print_simulation(work, found, cost);
    return rapid_count(found) == 0 ? 0 : 1;
}

} // namespace

void add_simulate_command(CLI::App& app, Command& chosen) {
    const auto options = std::make_shared<SimulateOptions>();
    CLI::App& command = *app.add_subcommand(
        "simulate", "Cut a stock by a program: what is left, and rapid moves that go through material");
    command.add_option("FILE", options->file, "Project, or G-code file")->required();
    command.add_option("--machine", options->machine, "Shipped machine or machine file, of a G-code file")
        ->type_name("NAME|FILE");
    command
        .add_option("--stock",
                    options->stock,
                    "box:LX,LY,LZ[@X,Y,Z], cylinder:D,L[,x|y|z][@X,Y,Z], tube:D,BORE,L[,x|y|z][@X,Y,Z] or "
                    "FILE.stl[@X,Y,Z]; of a project by default the box of its surface and 2 mm more")
        ->type_name("SPEC");
    command
        .add_option(
            "--tool",
            options->tools,
            "flat:D, ball:D, bull:D:R, v:ANGLE:D[:TIP|:rR], drill:D[:ANGLE], each with :lLENGTH, or a "
            "tool file; N=SPEC for the tool of T N, once for each")
        ->type_name("[N=]SPEC")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command.add_option("--resolution", options->resolution, "Distance of the lines that are cut, mm")
        ->type_name("MM")
        ->check(above_zero());
    command.add_option("--memory", options->memory_mb, "Memory that they may take, MB")
        ->type_name("MB")
        ->check(above_zero());
    add_origin_option(command, options->origin);
    command.add_option("--dialect", options->dialect, "Whose rules hold")
        ->check(CLI::IsMember({"linuxcnc", "grbl"}))
        ->capture_default_str();
    command
        .add_option("--subroutines",
                    options->subroutines,
                    "Folder of subroutine files, searched after the program's own")
        ->type_name("FOLDER")
        ->check(CLI::ExistingDirectory)
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command.add_flag("--block-delete", options->block_delete, "Leave out lines that begin with /");
    command.add_option("--out", options->out, "Folder for simulation.json, cut.stl, cut.ply and cut.png")
        ->required()
        ->type_name("DIR");
    command.callback([&chosen, options] { chosen = [options] { return simulate(*options); }; });
}

} // namespace millwright::app
