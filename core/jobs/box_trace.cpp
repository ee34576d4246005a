#include "core/jobs/box_trace.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace millwright::jobs {

Job box_trace_job(const Job& job, const ProgramCheck& program_check) {
    constexpr std::size_t x_axis = 0, y_axis = 1, z_axis = 2;
    constexpr int feed = 1000; // mm/min: slow enough to look, and to stop
    const ProgramCheck::Range& x = program_check.cuts[x_axis];
    const ProgramCheck::Range& y = program_check.cuts[y_axis];
    if (x.empty() || y.empty() || (!(x.min < x.max) && !(y.min < y.max))) {
        throw Error("the program has no cuts to trace a box around", {job.project}, "");
    }
    std::string text = "(box of the cuts, machine coordinates)\nM5\nG21 G90 G94 G40\n";
    const ProgramCheck::Range& z = program_check.ranges[z_axis];
    const auto& start = program_check.start[z_axis];
    if (!z.empty() && (!start || z.max > *start)) {
        text += fmt::format("G53 G0 Z{:.3f}\n", z.max);
    }
    const std::array corners{std::pair(x.min, y.min),
                             std::pair(x.max, y.min),
                             std::pair(x.max, y.max),
                             std::pair(x.min, y.max),
                             std::pair(x.min, y.min)};
    for (const auto& [at_x, at_y] : corners) {
        text += fmt::format("G53 G1 X{:.3f} Y{:.3f} F{}\n", at_x, at_y, feed);
    }
    Job trace = text_job(text + "M2\n", job.name + "-box");
    trace.project = "the box of " + job.project;
    return trace;
}

} // namespace millwright::jobs
