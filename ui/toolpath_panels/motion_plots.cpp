#include "ui/toolpath_panels/motion_plots.h"

#include "ui/panels/lines.h"
#include "ui/widgets/plot.h"

#include <array>

namespace millwright::panels {

namespace {

constexpr int motion_plot_columns = 900;
constexpr std::array<widgets::Option, 2> motion_plot_choices{
    {{"feed", "Feed rate and limits"}, {"axes", "Axis velocities"}}};

} // namespace

const MotionSeries& MotionPlots::series(const FrameState& now) {
    const auto trajectory = now.trajectory();
    const bool as_programmed = !trajectory && now.in_file() && now.opened->execution &&
                               now.opened->finished && now.opened->seconds > 0.0 && !now.opened->path.empty();
    std::shared_ptr<const void> source;
    if (trajectory) {
        source = trajectory;
    } else if (as_programmed) {
        source = now.opened;
    }
    if (source == source_) {
        return series_;
    }
    source_ = std::move(source);
    series_ = {};
    if (trajectory) {
        const kinematics::MachineModel& machine =
            now.in_file() ? *now.opened->machine : now.plan->plan.cutting_setup->machine;
        series_ = motion_series(*trajectory, *now.program(), machine, motion_plot_columns);
    } else if (as_programmed) {
        series_ = programmed_series(*now.opened, motion_plot_columns);
    }
    return series_;
}

void MotionPlots::draw(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const MotionSeries& all = series(now);
    if (all.time.empty()) {
        ui.note("No motion is planned yet.");
        return;
    }
    if (!all.axes.empty()) {
        const auto width = ui.width(ui.px(380.0F));
        if (const auto chosen = ui.segmented("shown", "", static_cast<int>(shown_), motion_plot_choices)) {
            shown_ = static_cast<Shown>(*chosen);
        }
    } else {
        shown_ = Shown::feed;
    }
    std::vector<widgets::Series> lines;
    for (const NamedCurve& curve : shown_ == Shown::feed ? all.by_limit : all.axes) {
        lines.push_back({curve.name, all.time, curve.values, 0, false});
    }
    widgets::PlotView view;
    view.x_label = "time";
    view.x_unit = "s";
    view.y_label = shown_ == Shown::feed ? "feed" : "utilisation of the axis limit";
    view.y_unit = shown_ == Shown::feed ? "mm/min" : "%";
    view.series = lines;
    view.cursor_x = now.time();
    if (shown_ == Shown::axes) {
        view.limit_y = 100.0;
    }
    if (const auto time = widgets::line_plot(ui, "motion", view); time && !now.follows_job()) {
        go_to_time(ask, *time);
    }
}

} // namespace millwright::panels
