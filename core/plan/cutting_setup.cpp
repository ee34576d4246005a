#include "core/plan/cutting_setup.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/geometry/self_crossing.h"
#include "core/kinematics/machine_file.h"
#include "core/kinematics/rotary_tilt.h"
#include "core/project/assets.h"
#include "core/project/surface.h"
#include "core/project/tool_settings.h"

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

namespace millwright::plan {

namespace {

/// What was trimmed away may cross what it likes.
void refuse_crossing(const geometry::ParametricSurface& patch, const geometry::Trim& trim) {
    if (!trim.everything()) {
        return;
    }
    if (const auto crossing = geometry::self_crossing(patch)) {
        throw Error(fmt::format("the surface touches or intersects itself: near u {:.2f}, v {:.2f} it meets "
                                "the point at u {:.2f}, v {:.2f}",
                                crossing->first.x(),
                                crossing->first.y(),
                                crossing->second.x(),
                                crossing->second.y()),
                    {},
                    "move the control points apart, or split the surface: a tool cuts from one side");
    }
}

/// The machine with the constants of the project. Throws Error with the field where it has no such constants.
kinematics::MachineModel with_tool_set(const kinematics::MachineModel& machine,
                                       const project::ToolSetInput& set) {
    const Vec3 part = machine.description().workpiece_offset;
    try {
        return kinematics::with_rotary_tilt(machine,
                                            {.a = part.x(),
                                             .b = part.y(),
                                             .c = part.z(),
                                             .e = set.e,
                                             .AB = set.AB,
                                             .B4 = set.B4,
                                             .OF = set.OF});
    } catch (const Error& fault) {
        throw Error("machine/tool_set: " + fault.diagnostic().message,
                    {},
                    "omit tool_set, or choose a machine of the thesis");
    }
}

} // namespace

void refuse_faults(const project::Project& project) {
    const std::vector<std::string> faults = project::faults_of(project);
    if (!faults.empty()) {
        throw Error(faults.front());
    }
}

CuttingSetup cutting_setup_of(const project::Project& project, const Folders& folders) {
    return cutting_setup_of(project, folders, project::machined_region(project.surface));
}

CuttingSetup cutting_setup_of(const project::Project& project, const Folders& folders, region::Region patch) {
    refuse_crossing(patch, project.surface.machined_trim());
    kinematics::MachineModel machine =
        kinematics::read_machine(project::machine_path(project, folders.project, folders.assets));
    if (const auto& set = project.machine.tool_set) {
        machine = with_tool_set(machine, *set);
    }
    machine = project::machine_with(project.tool, machine);
    if (project.machine.workpiece_offset) {
        machine = machine.with_workpiece_offset(*project.machine.workpiece_offset);
    }
    return {std::move(patch),
            std::move(machine),
            project.grid.direction,
            project.surface.flipped,
            project.machine.angle_mode,
            project::tool_of(project.tool),
            sequencing_settings(project),
            timing(project),
            project.surface.machined_trim()};
}

project::ProgramInput timing(const project::Project& project) {
    return project.sequencing.goal == toolpath::SequencingGoal::time ? project.program
                                                                     : project::ProgramInput{};
}

toolpath::SequencingSettings sequencing_settings(const project::Project& project) {
    using toolpath::SequencingGoal;
    toolpath::SequencingSettings settings;
    settings.goal = project.sequencing.goal;
    settings.largest_step = from_degrees(project.sequencing.largest_step_deg);
    if (settings.goal == SequencingGoal::time) {
        settings.feed = from_mm_per_min(project.program.feed_mm_per_min);
    }
    settings.links_cut =
        settings.goal == SequencingGoal::error && project.program.link == project::LinkInput::on_surface;
    return settings;
}

} // namespace millwright::plan
