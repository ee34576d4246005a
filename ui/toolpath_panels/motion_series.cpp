#include "ui/toolpath_panels/motion_series.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/base/units.h"
#include "ui/toolpath_panels/program_file_panel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace millwright::panels {

namespace {

constexpr int moments_per_column = 6;
constexpr double gap = std::numeric_limits<double>::quiet_NaN();

double speed_of(const motion::Sample& sample, const kinematics::MachineModel& machine) {
    double sum = 0.0;
    for (const int axis : machine.linear_axes()) {
        sum += square(sample.velocity[axis]);
    }
    return to_mm_per_min(std::sqrt(sum));
}

NamedCurve& curve_named(std::vector<NamedCurve>& curves, const std::string& name, std::size_t columns) {
    const auto found = std::ranges::find(curves, name, &NamedCurve::name);
    if (found != curves.end()) {
        return *found;
    }
    return curves.emplace_back(NamedCurve{name, std::vector<double>(columns, gap)});
}

/// Each piece reaches to the first value of the next, so that no hole is seen between them.
void put(MotionSeries& series, std::size_t column, const std::string& limit, double feed) {
    series.feed.push_back(feed);
    NamedCurve& curve = curve_named(series.by_limit, limit, series.time.size());
    curve.values[column] = feed;
    if (column > 0 && !std::isfinite(curve.values[column - 1])) {
        curve.values[column - 1] = series.feed[column - 1];
    }
}

std::vector<double> even_times(double duration, int columns) {
    expects(columns >= 2, "a series has two columns or more");
    std::vector<double> times;
    for (int n = 0; n < columns; ++n) {
        times.push_back(duration * n / (columns - 1));
    }
    return times;
}

} // namespace

MotionSeries motion_series(const motion::Trajectory& trajectory,
                           const program::Program& program,
                           const kinematics::MachineModel& machine,
                           int columns) {
    MotionSeries series;
    series.time = even_times(trajectory.duration(), columns);
    for (const kinematics::MachineAxis& axis : machine.axes()) {
        series.axes.push_back({std::string(1, axis.letter), {}});
    }
    const double step = trajectory.duration() / (columns - 1);
    for (std::size_t column = 0; column < series.time.size(); ++column) {
        double fastest = -1.0;
        double fastest_time = 0.0;
        std::vector<double> shares(series.axes.size(), 0.0);
        for (int k = 0; k < moments_per_column; ++k) {
            const double time =
                std::clamp(series.time[column] + step * (static_cast<double>(k) / moments_per_column - 0.5),
                           0.0,
                           trajectory.duration());
            const motion::Sample sample = trajectory.at(time);
            if (const double speed = speed_of(sample, machine); speed > fastest) {
                fastest = speed;
                fastest_time = time;
            }
            for (std::size_t n = 0; n < shares.size(); ++n) {
                const double share = std::abs(sample.velocity[static_cast<Eigen::Index>(n)]) /
                                     machine.axis(static_cast<int>(n)).max_velocity;
                shares[n] = std::max(shares[n], 100.0 * share);
            }
        }
        put(series, column, limit_text(trajectory.limit_at(fastest_time), program), fastest);
        for (std::size_t n = 0; n < shares.size(); ++n) {
            series.axes[n].values.push_back(shares[n]);
        }
    }
    return series;
}

MotionSeries programmed_series(const plan::OpenedProgram& opened, int columns) {
    MotionSeries series;
    series.time = even_times(opened.seconds, columns);
    for (std::size_t column = 0; column < series.time.size(); ++column) {
        const gcode::PreviewPoint& point = opened.path.point(opened.path.place_at(series.time[column]).point);
        const gcode::ModalView state = opened.execution->state_after(point.step());
        const double unit = state.unit == gcode::LengthUnit::inch ? gcode::mm_per_inch : 1.0;
        const bool rapid = point.kind() == gcode::PathKind::rapid;
        const double feed = rapid ? 0.0 : static_cast<double>(state.feed) * unit;
        put(series, column, rapid ? "rapid" : "programmed feed", feed);
    }
    return series;
}

} // namespace millwright::panels
