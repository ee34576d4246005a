#include "core/jobs/internal/planned_text.h"

#include "core/base/units.h"
#include "core/gcode/axes.h"
#include "core/gcode/interpreter.h"
#include "core/gcode_programs/machine_program.h"
#include "core/gcode_programs/work_origin.h"

#include <fmt/format.h>

#include <algorithm>
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
