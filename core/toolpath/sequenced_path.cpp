#include "core/toolpath/sequenced_path.h"

#include "core/toolpath/shortest_sequence.h"
#include "core/toolpath/small_rotations.h"

#include <utility>

namespace millwright::toolpath {

namespace {

AxisPath axes_by_goal(const geometry::ParametricSurface& patch,
                      const kinematics::MachineModel& machine,
                      const Toolpath& path,
                      const SequencingSettings& settings,
                      const Progress& progress) {
    switch (settings.goal) {
    case SequencingGoal::nearest:
        break;
    case SequencingGoal::travel:
        return shortest_sequence(machine, path, travel_costs(machine), 1.0, progress);
    case SequencingGoal::error:
        return shortest_sequence(machine,
                                 path,
                                 error_costs(patch, machine, path, {}, grid::coarse),
                                 settings.links_cut ? 1.0 : 0.0,
                                 progress);
    case SequencingGoal::time:
        return shortest_sequence(machine, path, time_costs(machine, path, settings.feed), 1.0, progress);
    }
    return sequence(machine, path);
}

} // namespace

SequencedPath sequenced(const geometry::ParametricSurface& patch,
                        const kinematics::MachineModel& machine,
                        Toolpath toolpath,
                        const SequencingSettings& settings,
                        const Progress& progress) {
    constexpr int rounds = 4; // with more points other branches may be chosen, which turn by more elsewhere
    AxisPath axes = axes_by_goal(patch, machine, toolpath, settings, progress.part(0.0, 1.0 / rounds));
    const auto turns_too_far = [&] {
        return settings.largest_step > 0.0 &&
               largest_rotary_step(machine, toolpath, axes, MoveKind::track) > settings.largest_step;
    };
    for (int n = 1; n < rounds && turns_too_far(); ++n) {
        const Progress part =
            progress.part(static_cast<double>(n) / rounds, static_cast<double>(n + 1) / rounds);
        toolpath =
            with_small_rotations(patch, machine, toolpath, axes, settings.largest_step, part.part(0.0, 0.5));
        axes = axes_by_goal(patch, machine, toolpath, settings, part.part(0.5, 1.0));
    }
    return {std::move(toolpath), std::move(axes)};
}

} // namespace millwright::toolpath
