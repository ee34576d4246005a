#include "core/machine/file_job.h"

#include "core/base/files.h"
#include "core/gcode/plot_program.h"
#include "core/gcode/reader/interpreter.h"
#include "core/gcode/reader/machine_program.h"
#include "core/plot/path_file.h"

#include <algorithm>
#include <string>
#include <utility>

namespace millwright::machine {

namespace {

void throw_first(const std::vector<Diagnostic>& faults) {
    if (!faults.empty()) {
        throw Error(faults.front());
    }
}

gcode::Program program_of_gcode(const std::string& text,
                                const std::filesystem::path& file,
                                const kinematics::MachineModel& machine,
                                const FileJobSettings& settings) {
    gcode::ReaderSettings reading;
    reading.dialect = settings.dialect;
    reading.any_tool = true;
    reading.subroutine_folders = {file.parent_path().empty() ? "." : file.parent_path()};
    gcode::MachineProgramBuilder builder(machine, file, {.start = settings.start});
    gcode::Interpreter program(text, file, std::move(reading), builder);
    program.run();
    throw_first(program.errors());
    gcode::MachineProgram made = builder.take();
    throw_first(made.faults);
    return std::move(made.program);
}

/// The records stand below the title, blank lines between them or not.
gcode::Program program_of_path(const std::string& text,
                               const std::filesystem::path& file,
                               const kinematics::MachineModel& machine,
                               const FileJobSettings& settings) {
    std::vector<int> lines;
    const plot::CutPath path = plot::read_path(text, file, &lines);
    gcode::Program program = gcode::plot_program(
        path, {.machine = machine.name(), .axes = gcode::plot_axes(machine), .spindle_rpm = 0.0});
    for (gcode::Block& block : program.blocks) {
        block.source_line = block.path_point < 0 ? 1 : lines[static_cast<std::size_t>(block.path_point)];
    }
    program.start = settings.start.value_or(program.start);
    return program;
}

} // namespace

gcode::Listing listing_of(std::string_view text, const gcode::Program& program) {
    gcode::Listing listing;
    listing.text = text;
    if (listing.text.empty() || listing.text.back() != '\n') {
        listing.text += '\n';
    }
    listing.line_starts.push_back(0);
    for (std::size_t n = 0; n < listing.text.size(); ++n) {
        if (listing.text[n] == '\n') {
            listing.line_starts.push_back(n + 1);
        }
    }
    for (const gcode::Block& block : program.blocks) {
        listing.line_of_block.push_back(std::max(block.source_line, 1));
    }
    return listing;
}

Job file_job(const std::filesystem::path& file,
             std::shared_ptr<const kinematics::MachineModel> machine,
             const FileJobSettings& settings) {
    const std::string text = read_file(file);
    gcode::Program program = plot::is_path_file(text) ? program_of_path(text, file, *machine, settings)
                                                      : program_of_gcode(text, file, *machine, settings);
    const bool moves = std::ranges::any_of(program.blocks, &gcode::Block::moves);
    if (!moves) {
        throw Error("the program moves nothing", file);
    }
    Job job;
    job.name = file.stem().string();
    job.project = file.string();
    job.listing = std::make_shared<const gcode::Listing>(listing_of(text, program));
    job.program = std::make_shared<const gcode::Program>(std::move(program));
    job.machine = std::move(machine);
    return job;
}

} // namespace millwright::machine
