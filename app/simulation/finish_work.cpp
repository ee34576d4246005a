#include "app/simulation/finish_work.h"

#include "app/command_line/option_values.h"
#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/base/units.h"
#include "core/kinematics/machine_file.h"
#include "core/mesh_finish/finish_program.h"
#include "core/plan/named_tool.h"
#include "core/plan/plot_time.h"
#include "core/project/assets.h"
#include "core/project/tool_settings.h"
#include "core/simulation/resolution.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <utility>

namespace millwright::app {

namespace {

namespace fs = std::filesystem;

Vec3 vector_of(const std::vector<double>& numbers, const Vec3& otherwise) {
    return numbers.empty() ? otherwise : Vec3(numbers.at(0), numbers.at(1), numbers.at(2));
}

/// Of the mesh and what is made of it; the inspection ends before the surface of the check is made.
std::size_t memory_of(const exchange::TriangleMesh& mesh) {
    const std::size_t triangles = mesh.triangles.size();
    return mesh_finish::DropTree::memory(triangles, mesh.points.size()) +
           std::max(mesh_finish::inspection_memory(triangles), plan::finish_check_memory(triangles));
}

exchange::MeshFile placed_mesh(const FinishOptions& options, const Progress& progress) {
    exchange::MeshFile found = exchange::read_mesh(options.file, options.mm_per_unit, progress);
    const Vec3 shift = vector_of(options.shift, Vec3::Zero());
    for (Vec3& point : found.mesh.points) {
        point += shift;
    }
    try {
        mesh_finish::expect_usable(found.mesh);
    } catch (const Error& error) {
        Diagnostic diagnostic = error.diagnostic();
        diagnostic.place.file = options.file;
        throw Error(std::move(diagnostic));
    }
    const std::size_t wanted = memory_of(found.mesh);
    if (const auto free = free_memory(); free && wanted > *free) {
        throw Error(fmt::format("{} take {} MB, and {} MB of memory are free",
                                counted(found.mesh.triangles.size(), "triangle"),
                                wanted / 1'000'000,
                                *free / 1'000'000),
                    options.file,
                    "reduce the mesh");
    }
    return found;
}

/// An open mesh all of whose triangles were written from below is turned over. Returns whether it was.
bool turn_up(exchange::TriangleMesh& mesh, const mesh_finish::MeshInspection& found, const Vec3& axis) {
    double up = 0.0;
    double area = 0.0;
    for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
        up += mesh.doubled_area(n).dot(axis);
        area += mesh.doubled_area(n).norm();
    }
    constexpr double closed = 1e-6; // the areas of a closed body cancel out
    if (found.open_edges.count == 0 || !(up < -closed * area)) {
        return false;
    }
    for (auto& triangle : mesh.triangles) {
        std::swap(triangle[1], triangle[2]);
    }
    return true;
}

/// The tool, and what it changes in machine and program.
FinishTool tool_of(const FinishOptions& options,
                   kinematics::MachineModel& machine,
                   program::Program& program,
                   std::vector<std::string>& remarks) {
    const plan::NamedTool named = plan::named_tool(options.tool, machine, remarks);
    if (named.machine) {
        machine = kinematics::MachineModel(*named.machine);
    }
    if (named.input) {
        program.tool = project::program_tool(*named.input, machine);
        if (const auto cutter = project::program_cutter(*named.input)) {
            program.cutters.push_back(*cutter);
        }
    } else {
        const toolpath::ProfileShape& shape = named.body.shape();
        program.cutters.push_back({.number = named.number.value_or(0),
                                   .diameter = 2.0 * shape.radius,
                                   .corner_radius = shape.corner});
        if (named.number) {
            program.tool = program::ProgramTool{.number = *named.number};
        }
    }
    return {named.body, named.holder, named.text};
}

double step_of(const FinishOptions& options, const toolpath::ProfileShape& tool) {
    if (options.step_over) {
        return *options.step_over;
    }
    if (!(tool.corner > 0.0)) {
        throw UsageError("a tool without a corner radius leaves steps on every slope, whatever the scallop",
                         {},
                         "give the distance of the passes with --step-over");
    }
    return mesh_finish::step_for_scallop(tool.corner, options.scallop);
}

mesh_finish::FinishSettings settings_of(const FinishOptions& options, const FinishTool& tool) {
    const Vec3 axis = vector_of(options.axis, Vec3::UnitZ());
    if (!(axis.norm() > 0.0)) {
        throw UsageError("--axis 0,0,0 is no direction", {}, "write --axis 0,0,1, away from the part");
    }
    std::optional<mesh_finish::FinishHolder> holder;
    if (tool.holder) {
        holder = {tool.holder->shape().radius, tool.body.shape().top};
    }
    return {.axis = axis.normalized(),
            .direction = from_degrees(options.direction_deg),
            .step_over = step_of(options, tool.body.shape()),
            .tolerance = options.tolerance,
            .overrun = options.overrun,
            .across = !options.one_way,
            .link_clearance = options.link_clearance,
            .allowance = options.allowance,
            .holder = holder};
}

void expect_room_for_holder(const FinishWork& work) {
    if (!work.holder_reach || work.holder_reach->length <= work.tool.body.shape().top) {
        return;
    }
    const Vec3& tip = work.holder_reach->tip;
    throw Error(fmt::format("the holder meets the mesh with the tip at {:.3f} {:.3f} {:.3f}: the tool is "
                            "{:.3f} mm long, and {:.3f} mm are needed",
                            tip.x(),
                            tip.y(),
                            tip.z(),
                            work.tool.body.shape().top,
                            work.holder_reach->length),
                {},
                "use a longer tool, or a holder of a smaller diameter");
}

std::vector<std::string> comments_of(const FinishOptions& options, const FinishWork& work) {
    return {fmt::format("finish: {}", printable(fs::path(options.file).filename().string())),
            fmt::format("tool: {}", work.tool.text),
            fmt::format("step-over {:.4f} mm, chord tolerance {:.4f} mm",
                        work.settings.step_over,
                        work.settings.tolerance)};
}

void make_program(const FinishOptions& options, FinishWork& work, const Progress& progress) {
    program::ProgramSettings settings;
    settings.cutting_feed = from_mm_per_min(options.feed_mm_per_min);
    settings.plunge_feed = from_mm_per_min(options.plunge_mm_per_min);
    settings.spindle_rpm = options.spindle_rpm;
    program::Program made = mesh_finish::finish_program(
        work.machine, work.path, settings, comments_of(options, work), progress.part(0.0, 0.2));
    made.tool = work.program.tool;
    made.cutters = work.program.cutters;
    work.program = std::move(made);
    progress.report(0.2, "writing the program");
    work.text = posted(work.program, work.machine, options.post, fs::path(options.file).stem().string());
    progress.report(0.6, "planning the motion");
    work.seconds = plan::seconds_of_text(
        work.text.text, work.text.format, work.machine, "program", progress.part(0.6, 1.0));
}

} // namespace

FinishWork finish_work(const FinishOptions& options, const Progress& progress) {
    const fs::path machine_file =
        project::machine_path(options.machine, fs::current_path(), project::assets_folder());
    kinematics::MachineModel machine = kinematics::read_machine(machine_file);
    program::Program program;
    std::vector<std::string> remarks;
    FinishTool tool = tool_of(options, machine, program, remarks);
    const mesh_finish::FinishSettings settings = settings_of(options, tool);
    if (!settings.allowance) {
        remarks.emplace_back(
            "material above the mesh is not known: links below the top of the mesh are at the "
            "feed rate, and nothing must be higher than the clearance above it (--allowance)");
    }
    FinishWork work{.mesh = placed_mesh(options, progress.part(0.0, 0.05)),
                    .remarks = std::move(remarks),
                    .machine = std::move(machine),
                    .tool = std::move(tool),
                    .settings = settings,
                    .path = {},
                    .program = std::move(program),
                    .text = {},
                    .part = {},
                    .check = {}};
    exchange::TriangleMesh& mesh = work.mesh.mesh;
    work.memory = memory_of(mesh);
    mesh_finish::MeshInspection found = mesh_finish::inspect(mesh, progress);
    for (std::string& remark : mesh_finish::remarks_of(found)) {
        work.remarks.push_back(std::move(remark));
    }
    if (turn_up(mesh, found, settings.axis)) {
        found = mesh_finish::inspect(mesh, progress);
        work.remarks.emplace_back("the triangles face away from the tool and are turned over");
    }
    const Mat3 frame = mesh_finish::pass_frame(settings.axis, settings.direction);
    const mesh_finish::DropTree tree = mesh_finish::drop_tree(mesh, found.open, frame, progress);
    const mesh_finish::CutterOutline outline(work.tool.body);
    work.path = mesh_finish::finish(tree, outline, settings, progress.part(0.05, 0.3));
    if (settings.holder) {
        work.holder_reach =
            mesh_finish::holder_reach(tree, frame, work.path, *settings.holder, progress.part(0.3, 0.35));
        expect_room_for_holder(work);
    }
    make_program(options, work, progress.part(0.35, 0.55));
    work.part = plan::part_surface(mesh, printable(fs::path(options.file).filename().string()), progress);
    work.check = plan::check_finish({.tree = tree,
                                     .frame = frame,
                                     .part = work.part,
                                     .program = work.program,
                                     .machine = work.machine,
                                     .cutter = work.tool.body,
                                     .overrun = options.overrun,
                                     .allowance = options.allowance,
                                     .tolerance = options.left_tolerance,
                                     .most_bytes = simulation::field_memory(options.memory_mb)},
                                    progress.part(0.55, 1.0));
    return work;
}

} // namespace millwright::app
