#include "ui/window/timeline_panel.h"

#include "ui/panels/lines.h"
#include "ui/widgets/timeline.h"
#include "ui/window/view_panel.h"

#include <algorithm>
#include <array>
#include <vector>

namespace millwright::panels {

namespace {

using widgets::TimelineAsk;

std::string_view action_of(TimelineAsk::Kind kind) {
    switch (kind) {
    case TimelineAsk::Kind::first:
        return "play.first";
    case TimelineAsk::Kind::back:
        return "play.back";
    case TimelineAsk::Kind::step:
        return "play.forward";
    case TimelineAsk::Kind::last:
        return "play.last";
    default:
        return "play.toggle";
    }
}

void obey(const TimelineAsk& asked, const FrameState& now, ActionQueue& ask) {
    if (asked.kind == TimelineAsk::Kind::scrub) {
        const auto planned = now.trajectory();
        go_to_time(ask,
                   now.in_file() || !planned
                       ? asked.value * now.duration()
                       : planned->time_at_part_length(asked.value * planned->part_length()));
    } else if (asked.kind == TimelineAsk::Kind::speed) {
        ask.show(
            [speed = asked.value](actions::ViewState& view_state) { view_state.playback.speed = speed; });
    } else {
        ask.run(std::string(action_of(asked.kind)));
    }
}

/// What runs though no program is opened here, as the machine tells it.
void draw_job(Ui& ui, const jobs::JobReport& job) {
    widgets::TimelineView view;
    view.permission = widgets::Permission::refused("A job is running: see the Machine workspace.");
    view.blocks = job.blocks;
    view.block = std::min(std::max(job.driver.executed_blocks, job.driver.block) + 1, job.blocks);
    view.fraction = job.fraction();
    view.time_s = job.elapsed;
    view.total_s = std::max(job.planned_time, job.elapsed);
    (void)widgets::timeline(ui, "timeline", view);
}

/// What is played to a table, point by point.
void draw_table_play(Ui& ui, const FrameState& now) {
    const actions::TableView table = now.plot.table().view();
    widgets::TimelineView view;
    view.permission = widgets::Permission::refused("The view follows the table.");
    view.what = "Point";
    view.block = table.status.points;
    view.blocks = table.total;
    view.time_s = table.status.time;
    view.total_s = table.duration;
    view.fraction = view.total_s > 0.0 ? view.time_s / view.total_s : 0.0;
    (void)widgets::timeline(ui, "timeline", view);
}

} // namespace

void TimelinePanel::refresh(const FrameState& now) {
    const auto trajectory = now.trajectory();
    const auto program = now.program();
    const auto evaluation = now.program_path();
    if (trajectory == trajectory_) {
        return;
    }
    trajectory_ = trajectory;
    constexpr int columns = 800;
    series_ = trajectory && program && evaluation
                  ? series_over_way(*trajectory, *program, *evaluation, columns)
                  : TrajectorySeries{};
}

/// Over time: a file may have no plan, and then no way of the tip to count by.
void TimelinePanel::draw_file(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const MotionSeries& motion = motion_.series(now);
    const std::array<widgets::TimelineSeries, 1> series{{{"feed", "mm/min", motion.feed, 0}}};
    widgets::TimelineView view;
    const auto place = now.file_place();
    if (!place) {
        view.permission = widgets::Permission::refused(
            now.opened->finished ? "The program contains no motion." : "Reading the program \u2026");
        (void)widgets::timeline(ui, "timeline", view);
        return;
    }
    view.series = series;
    view.total_s = now.duration();
    view.time_s = now.time();
    view.fraction = view.total_s > 0.0 ? view.time_s / view.total_s : 0.0;
    view.is_playing = now.view_state.playback.playing;
    view.speed = now.view_state.playback.speed;
    view.block = place->line;
    view.blocks = now.opened->text->lines().count();
    view.what = "Line";
    if (now.follows_job()) {
        view.permission = widgets::Permission::refused("The view follows the running job.");
    }
    if (const auto asked = widgets::timeline(ui, "timeline", view)) {
        obey(*asked, now, ask);
    }
}

/// Of a plot whose program is not there.
void TimelinePanel::draw_nothing(Ui& ui, const FrameState& now) const {
    const auto made = now.plot.latest();
    const bool long_one = made && made->path && made->path->size() > plan::most_points_at_once;
    widgets::TimelineView view;
    view.permission = widgets::Permission::refused(
        now.plot.file().empty() ? "No file is open."
        : long_one
            ? "With more than 100,000 points, the program is available only after it is written to a file."
            : "There is no program yet.");
    (void)widgets::timeline(ui, "timeline", view);
}

void TimelinePanel::draw(Ui& ui, const FrameState& now, ActionQueue& ask) {
    if (now.table_tip() && now.plot.table().playing()) {
        return draw_table_play(ui, now);
    }
    const bool plot = now.view_state.workspace == actions::Workspace::plot;
    if (plot && now.job.running && now.job.report) { // no job is of the plot
        return draw_job(ui, *now.job.report);
    }
    if (now.in_file()) {
        return draw_file(ui, now, ask);
    }
    if (plot) {
        return draw_nothing(ui, now);
    }
    refresh(now);
    widgets::TimelineView view;
    const std::array<widgets::TimelineSeries, 2> series{
        {{"error", "mm", series_.error, 0}, {"feed", "mm/min", series_.feed_mm_per_min, 0}}};
    if (!trajectory_ || shows_import(now)) {
        view.permission = widgets::Permission::refused(
            trajectory_ ? "The imported surface has no program yet." : "There is no program yet.");
        (void)widgets::timeline(ui, "timeline", view);
        return;
    }
    view.series = series;
    const double way = trajectory_->part_length();
    view.fraction = way > 0.0 ? trajectory_->part_length_at(now.time()) / way : 0.0;
    view.is_playing = now.view_state.playback.playing;
    view.speed = now.view_state.playback.speed;
    view.block = now.block() + 1;
    view.blocks = trajectory_->block_count();
    view.time_s = now.time();
    view.total_s = trajectory_->duration();
    if (now.follows_job()) {
        view.permission = widgets::Permission::refused("The view follows the running job.");
    }
    if (const auto asked = widgets::timeline(ui, "timeline", view)) {
        obey(*asked, now, ask);
    }
}

} // namespace millwright::panels
