#include "core/jobs/file_job.h"

#include "core/base/files.h"
#include "core/base/units.h"
#include "core/gcode/axes.h"
#include "core/gcode/interpreter.h"
#include "core/gcode_programs/machine_program.h"
#include "core/gcode_programs/work_origin.h"
#include "core/plot/path_file.h"
#include "core/plot/plot_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

namespace millwright::jobs::internal {

namespace {

using kinematics::MachineModel;

/// mm and degrees, by the letters of the axes.
gcode::AxisValues for_the_reader(const MachineModel& machine, const kinematics::AxisPositions& positions) {
    gcode::AxisValues values;
    for (int n = 0; n < machine.axis_count(); ++n) {
        const kinematics::MachineAxis& axis = machine.axis(n);
        const auto letter = std::ranges::find(gcode::axis_letters, axis.letter);
        values[static_cast<std::size_t>(letter - gcode::axis_letters.begin())] =
            axis.kind == kinematics::AxisKind::rotary ? to_degrees(positions[n]) : positions[n];
    }
    return values;
}

} // namespace

Job planned_text(std::string_view text,
                 const std::filesystem::path& file,
                 std::shared_ptr<const MachineModel> machine,
                 const PlannedText& how) {
    gcode::ReaderSettings settings;
    settings.any_tool = true;
    if (how.origin) {
        gcode::put_origin(settings, *how.origin);
    }
    settings.subroutine_folders = {file.parent_path().empty() ? "." : file.parent_path()};
    if (how.start) { // what no word names stays where it is
        settings.start = for_the_reader(*machine, *how.start);
    }
    gcode::MachineProgramBuilder builder(*machine, file, {.start = how.start});
    gcode::Interpreter reader(text, file, std::move(settings), builder);
    reader.run();
    gcode::MachineProgram made = builder.take();
    for (const auto* faults : {&reader.errors(),
                               &std::as_const(made.faults),
                               &std::as_const(made.lost),
                               &std::as_const(made.unplaced)}) {
        if (!faults->empty()) {
            throw Error(faults->front());
        }
    }
    if (made.program.blocks.empty()) {
        throw Error(Diagnostic{{file, 1, 1, -1}, "the program contains nothing to execute", {}});
    }
    Job job;
    job.name = file.stem().string();
    job.project = file.string();
    job.machine = std::move(machine);
    job.listing = std::make_shared<const program::Listing>(gcode::listing_of(text, made.program));
    job.program = std::make_shared<const program::Program>(std::move(made.program));
    job.notices = std::move(made.simplified);
    job.hash = hash_of(*job.listing, how.origin.value_or(gcode::WorkOrigin()).at());
    return job;
}

std::string hash_of(const program::Listing& listing, const Vec3& origin) {
    return origin.isZero(0.0)
               ? std::string()
               : program_hash(fmt::format("{}at {} {} {}", listing.text, origin.x(), origin.y(), origin.z()));
}

} // namespace millwright::jobs::internal

namespace millwright::jobs {

namespace {

/// The records stand below the title, blank lines between them or not.
program::Program program_of_path(const std::string& text,
                                 const std::filesystem::path& file,
                                 const kinematics::MachineModel& machine,
                                 const FileJobSettings& settings) {
    std::vector<int> lines;
    plot::CutPath path = plot::read_path(text, file, &lines);
    const Vec3 origin = settings.origin.value_or(gcode::WorkOrigin()).at();
    for (plot::CutPoint& point : path) {
        point.at += origin;
    }
    program::Program program = plot::plot_program(
        path, {.machine = machine.name(), .axes = plot::plot_axes(machine), .spindle_rpm = 0.0});
    for (program::Block& block : program.blocks) {
        block.source_line = block.path_point < 0 ? 1 : lines[static_cast<std::size_t>(block.path_point)];
    }
    program.start = settings.start.value_or(program.start);
    return program;
}

} // namespace

Job file_job(const std::filesystem::path& file,
             std::shared_ptr<const kinematics::MachineModel> machine,
             const FileJobSettings& settings) {
    const std::string text = read_file(file);
    Job job;
    if (plot::is_path_file(text)) {
        program::Program program = program_of_path(text, file, *machine, settings);
        job.name = file.stem().string();
        job.project = file.string();
        job.listing = std::make_shared<const program::Listing>(gcode::listing_of(text, program));
        job.program = std::make_shared<const program::Program>(std::move(program));
        job.machine = std::move(machine);
        job.hash = internal::hash_of(*job.listing, settings.origin.value_or(gcode::WorkOrigin()).at());
    } else {
        job = internal::planned_text(
            text, file, std::move(machine), {.start = settings.start, .origin = settings.origin});
    }
    if (std::ranges::none_of(job.program->blocks, &program::Block::moves)) {
        throw Error(Diagnostic{{file, 1, 1, -1}, "the program contains no motion", {}});
    }
    return job;
}

} // namespace millwright::jobs
