#include "ui/toolpath_panels/motion_plots.h"

#include "ui/panels/lines.h"
#include "ui/widgets/plot.h"
#include "ui/workspaces/stock_workspace.h"

#include <array>
#include <cstddef>
#include <span>

namespace millwright::panels {

namespace {

constexpr int motion_plot_columns = 900;
/// In the order of Shown; the last two are of a simulation.
constexpr std::array<widgets::Option, 4> motion_plot_choices{{{"feed", "Feed rate and limits"},
                                                              {"axes", "Axis velocities"},
                                                              {"rate", "Removal rate"},
                                                              {"engagement", "Depth and width of cut"}}};

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

const EngagementSeries& MotionPlots::engagement(const FrameState& now) {
    const auto trajectory = now.trajectory();
    const auto result = trajectory && actions::stock_is_current(now) ? now.stock.view().result : nullptr;
    if (result != cut_) {
        cut_ = result;
        engagement_ =
            result ? engagement_series(result->feeds, *trajectory, motion_plot_columns) : EngagementSeries();
    }
    return engagement_;
}

void MotionPlots::draw(Ui& ui, const FrameState& now, ActionQueue& ask) {
    if (series(now).time.empty()) {
        ui.note("No motion is planned yet.");
        return;
    }
    const bool is_cut = !engagement(now).time.empty();
    if (series_.axes.empty()) {
        shown_ = Shown::feed;
    } else {
        const std::span<const widgets::Option> all(motion_plot_choices);
        const std::span<const widgets::Option> offered = is_cut ? all : all.first(2);
        if (static_cast<std::size_t>(shown_) >= offered.size()) {
            shown_ = Shown::feed;
        }
        const auto width = ui.width(ui.px(190.0F * static_cast<float>(offered.size())));
        if (const auto chosen = ui.segmented("shown", "", static_cast<int>(shown_), offered)) {
            shown_ = static_cast<Shown>(*chosen);
        }
    }
    draw_lines(ui, now, ask);
}

void MotionPlots::draw_lines(Ui& ui, const FrameState& now, ActionQueue& ask) {
    std::vector<widgets::Series> lines;
    widgets::PlotView view;
    view.x_label = "time";
    view.x_unit = "s";
    view.cursor_x = now.time();
    const auto add = [&](const std::vector<NamedCurve>& curves) {
        for (const NamedCurve& curve : curves) {
            lines.push_back({curve.name, series_.time, curve.values, 0, false});
        }
    };
    switch (shown_) {
    case Shown::feed:
        add(series_.by_limit);
        view.y_label = "feed";
        view.y_unit = "mm/min";
        break;
    case Shown::axes:
        add(series_.axes);
        view.y_label = "utilisation of the axis limit";
        view.y_unit = "%";
        view.limit_y = 100.0;
        break;
    case Shown::rate:
        lines.push_back({"Removal rate", engagement_.time, engagement_.rate});
        lines.push_back({"Feed in air", engagement_.time, engagement_.air, ui.colours().warning});
        view.y_label = "removal rate";
        view.y_unit = "mm\u00b3/min";
        break;
    case Shown::engagement:
        lines.push_back({"Depth of cut", engagement_.time, engagement_.depth});
        lines.push_back({"Width of cut", engagement_.time, engagement_.width});
        view.y_label = "engagement";
        view.y_unit = "mm";
        break;
    }
    view.series = lines;
    if (const auto time = widgets::line_plot(ui, "motion", view); time && !now.follows_job()) {
        go_to_time(ask, *time);
    }
}

} // namespace millwright::panels
