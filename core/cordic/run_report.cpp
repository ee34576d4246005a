#include "core/cordic/run_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace millwright::cordic {

namespace {

/// What the next clock does depends on all of the state but these.
ProcessorState without_counts(ProcessorState state) {
    state.clocks = {};
    state.instructions = 0;
    return state;
}

} // namespace

bool LoopDetector::came_back(const Processor& processor) {
    const CodeAddress at = processor.state().instruction_at;
    if (++looks_ != next_ && seen_ && seen_->state.instruction_at != at) {
        return false; // as nearly always
    }
    const ProcessorState now = without_counts(processor.state());
    if (seen_ && seen_->state == now && seen_->memory == processor.memory()) {
        return true;
    }
    if (looks_ == next_) {
        seen_ = {now, processor.memory()};
        looks_ = 0;
        next_ *= 2;
    }
    return false;
}

bool run_watched(Processor& processor, std::int64_t clocks) {
    LoopDetector watch;
    while (clocks > 0 && processor.state().stop == Stop::none) {
        clocks -= processor.run(std::min(clocks, LoopDetector::interval));
        if (processor.state().stop == Stop::none && watch.came_back(processor)) {
            return true;
        }
    }
    return false;
}

namespace {

struct SpacePoint {
    double x = 0.0, y = 0.0, z = 0.0;
};

/// Of a set-point.
struct Found {
    SpacePoint at, velocity;
};

double length(const SpacePoint& p) {
    return std::hypot(p.x, p.y, p.z);
}

SpacePoint operator-(const SpacePoint& a, const SpacePoint& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}

Found found(const Processor& processor, const Published& record) {
    const SetPoint<double> set = processor.set_point(record);
    const HeightPoint height = processor.height_point(record);
    return {{set.x, set.y, height.z}, {set.vx, set.vy, height.vz}};
}

/// In parts of the speed; 0 where the exact path does not move.
double speed_error(const Found& found, const ExactPoint& exact, const SpacePoint& from) {
    const SpacePoint way = SpacePoint{exact.x, exact.y, exact.z} - from;
    const double far = length(way);
    if (!(far > 0.0) || !(exact.speed > 0.0)) {
        return 0.0;
    }
    const double scale = exact.speed / far;
    return length(found.velocity - SpacePoint{scale * way.x, scale * way.y, scale * way.z}) / exact.speed;
}

void compare(RunReport& report,
             const Processor& processor,
             std::span<const ExactPoint> exact,
             SpacePoint from) {
    const auto& published = processor.published();
    for (std::size_t n = 0; n < std::min(exact.size(), published.size()); ++n) {
        const Found set = found(processor, published[n]);
        const SpacePoint to{exact[n].x, exact[n].y, exact[n].z};
        report.position_error = std::max(report.position_error, length(set.at - to));
        if (const double error = speed_error(set, exact[n], from); error > report.speed_error) {
            report.speed_error = error;
            report.speed_error_at = n;
        }
        from = to;
    }
}

/// A set-point that moves the axes, and what the processor has until the next such.
struct Motion {
    std::int64_t clock = 0;
    double way = 0.0, speed = 0.0;
};

/// While one motion is under way the next one is computed, and with it what between them moves nothing.
void find_late(RunReport& report, const Processor& processor, double clock_hz, SpacePoint from) {
    const auto& published = processor.published();
    std::optional<Motion> under_way;
    for (std::size_t n = 0; n < published.size(); ++n) {
        const Found set = found(processor, published[n]);
        const Motion next{published[n].clock, length(set.at - from), length(set.velocity)};
        if (!(next.way > 0.0)) {
            continue;
        }
        if (under_way) {
            const double computing = static_cast<double>(next.clock - under_way->clock) / clock_hz;
            if (under_way->way < under_way->speed * computing) {
                report.late.push_back(n);
            }
            const double fastest = under_way->way / computing;
            report.fastest = std::min(report.fastest.value_or(fastest), fastest);
        }
        under_way = next;
        from = set.at;
    }
}

const char* hint_for(Stop stop) {
    switch (stop) {
    case Stop::overflow:
        return "choose a number format with more integer bits";
    case Stop::no_number:
        return "write numbers in the program's format where it reads them";
    case Stop::no_speed:
        return "load both before the motion";
    case Stop::out_of_reach:
        return "use 4 or more iterations";
    default:
        return "";
    }
}

} // namespace

std::vector<PathDifference> path_differences(const Processor& processor, std::span<const ExactPoint> exact) {
    std::vector<PathDifference> differences;
    const std::size_t count = std::min(exact.size(), processor.published().size());
    for (std::size_t n = 0; n < count; ++n) {
        const SpacePoint at = found(processor, processor.published()[n]).at;
        const double distance = length(at - SpacePoint{exact[n].x, exact[n].y, exact[n].z});
        differences.push_back({exact[n], at.x, at.y, at.z, distance});
    }
    return differences;
}

RunReport report_of(const Processor& processor,
                    std::span<const ExactPoint> exact,
                    double clock_hz,
                    const std::array<double, 3>& start) {
    expects(clock_hz > 0.0, "a processor's clock runs");
    RunReport report;
    report.stop = processor.state().stop;
    report.published = static_cast<std::int64_t>(processor.published().size());
    report.expected = static_cast<std::int64_t>(exact.size());
    report.clocks = processor.state().clocks;
    report.seconds = static_cast<double>(report.clocks.total) / clock_hz;
    const SpacePoint from{start[0], start[1], start[2]};
    compare(report, processor, exact, from);
    find_late(report, processor, clock_hz, from);
    return report;
}

Diagnostic stop_diagnostic(const ProcessorState& state,
                           std::span<const CodeLine> lines,
                           const std::filesystem::path& file) {
    const CodeLine at = line_at(lines, state.instruction_at);
    return {.place = {file, at.line, at.column, -1},
            .message = fmt::format("the processor stopped at the instruction at {:#06x}: {}",
                                   state.instruction_at,
                                   to_text(state.stop)),
            .hint = hint_for(state.stop)};
}

} // namespace millwright::cordic
