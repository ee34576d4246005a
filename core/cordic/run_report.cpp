#include "core/cordic/run_report.h"

#include "core/base/error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace millwright::cordic {
namespace {

struct Point {
    double x = 0.0, y = 0.0;
};

/// In parts of the speed; 0 where the exact path does not move.
double speed_error(const SetPoint<double>& found, const ExactPoint& exact, const Point& from) {
    const double length = std::hypot(exact.x - from.x, exact.y - from.y);
    if (!(length > 0.0) || !(exact.speed > 0.0)) {
        return 0.0;
    }
    return std::hypot(found.vx - exact.speed * (exact.x - from.x) / length,
                      found.vy - exact.speed * (exact.y - from.y) / length) /
           exact.speed;
}

void compare(RunReport& report, const Processor& processor, std::span<const ExactPoint> exact) {
    const auto& published = processor.published();
    Point from;
    for (std::size_t n = 0; n < std::min(exact.size(), published.size()); ++n) {
        const SetPoint<double> found = processor.set_point(published[n]);
        report.position_error =
            std::max(report.position_error, std::hypot(found.x - exact[n].x, found.y - exact[n].y));
        report.speed_error = std::max(report.speed_error, speed_error(found, exact[n], from));
        from = {exact[n].x, exact[n].y};
    }
}

/// While one motion is under way the next set-point is computed.
void find_late(RunReport& report, const Processor& processor, double clock_hz) {
    const auto& published = processor.published();
    double fastest = std::numeric_limits<double>::max();
    Point from;
    for (std::size_t n = 0; n + 1 < published.size(); ++n) {
        const SetPoint<double> at = processor.set_point(published[n]);
        const double length = std::hypot(at.x - from.x, at.y - from.y);
        const double computing = static_cast<double>(published[n + 1].clock - published[n].clock) / clock_hz;
        const double speed = std::hypot(at.vx, at.vy);
        report.late += length < speed * computing ? 1 : 0;
        fastest = std::min(fastest, length / computing);
        from = {at.x, at.y};
    }
    report.fastest = published.size() > 1 ? fastest : 0.0;
}

} // namespace

RunReport report_of(const Processor& processor, std::span<const ExactPoint> exact, double clock_hz) {
    expects(clock_hz > 0.0, "a processor's clock runs");
    RunReport report;
    report.stop = processor.state().stop;
    report.published = static_cast<std::int64_t>(processor.published().size());
    report.expected = static_cast<std::int64_t>(exact.size());
    report.clocks = processor.state().clocks;
    report.seconds = static_cast<double>(report.clocks.total) / clock_hz;
    compare(report, processor, exact);
    find_late(report, processor, clock_hz);
    return report;
}

} // namespace millwright::cordic
