#include "core/jobs/file_job.h"

#include "core/base/files.h"
#include "core/gcode_programs/machine_program.h"
#include "core/jobs/internal/planned_text.h"
#include "core/plot/path_file.h"
#include "core/plot/plot_program.h"

#include <algorithm>
#include <string>
#include <utility>

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
