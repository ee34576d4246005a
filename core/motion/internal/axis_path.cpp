#include "core/motion/internal/axis_path.h"

#include "core/motion/internal/axis_path_builder.h"
#include "core/motion/internal/rounding_choice.h"
#include "core/motion/time_estimate.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace millwright::motion::internal {

namespace {

bool may_round(const program::Program& program, const PlannerSettings& settings) {
    return std::ranges::any_of(program.blocks, [&](const program::Block& block) {
        return block.moves() && block.path.value_or(settings.path).mode == program::PathMode::continuous;
    });
}

} // namespace

Path lay_out(const program::Program& program,
             const Mechanism& machine,
             const PlannerSettings& settings,
             const kinematics::AxisPositions& start,
             std::span<const double> accelerations,
             const Progress& progress) {
    check_axes(program.axes, program.machine, machine);
    check_settings(settings, machine, start);
    FilterTime filter(limits_of(machine), start);
    for (std::size_t n = 0; n < program.blocks.size() && !filter.settled(); ++n) {
        filter.add(program.blocks[n]);
    }
    const auto for_each_block = [&](const Progress& part, const auto& add) {
        constexpr std::size_t blocks_between_looks = 4096; // about 1 ms
        for (std::size_t n = 0; n < program.blocks.size(); ++n) {
            if (n % blocks_between_looks == 0) {
                part.check();
                part.report(static_cast<double>(n) / static_cast<double>(program.blocks.size()));
            }
            add(static_cast<int>(n),
                program.blocks[n],
                accelerations.empty() ? std::numeric_limits<double>::infinity() : accelerations[n]);
        }
    };
    std::vector<RoundingChoice::Section> sections;
    double chosen = 0.0; // of the work
    if (may_round(program, settings)) {
        chosen = 0.75;
        RoundingChoice choice(machine, settings, start, filter.seconds(), true);
        for_each_block(
            progress.part(0.0, chosen),
            [&](int, const program::Block& block, double acceleration) { choice.add(block, acceleration); });
        static_cast<void>(choice.finish());
        sections = choice.sections();
    }
    AxisPathBuilder builder(machine, settings, filter.seconds(), start, true);
    builder.reserve(program.blocks.size());
    auto section = sections.begin();
    for_each_block(progress.part(chosen, 1.0), [&](int n, const program::Block& block, double acceleration) {
        for (; section != sections.end() && section->first <= n; ++section) {
            builder.set_rounding_bounds(section->bounds);
        }
        builder.add(block, acceleration);
    });
    return builder.take(progress);
}

} // namespace millwright::motion::internal
