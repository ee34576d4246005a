#include "ui/panels/timeline_panel.h"

#include "ui/widgets/timeline.h"

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

void obey(const TimelineAsk& asked, const motion::Trajectory& trajectory, ActionQueue& ask) {
    if (asked.kind == TimelineAsk::Kind::scrub) {
        const double time = trajectory.time_at_part_length(asked.value * trajectory.part_length());
        ask.show([time](actions::Session& session) {
            session.playback.playing = false;
            session.playback.time = time;
        });
    } else if (asked.kind == TimelineAsk::Kind::speed) {
        ask.show([speed = asked.value](actions::Session& session) { session.playback.speed = speed; });
    } else {
        ask.run(std::string(action_of(asked.kind)));
    }
}

} // namespace

void TimelinePanel::refresh(const Workbench& now) {
    const auto trajectory = now.trajectory();
    const auto program = now.program();
    const auto evaluation = now.evaluation(now.project.grid.method);
    if (trajectory == trajectory_) {
        return;
    }
    trajectory_ = trajectory;
    constexpr int columns = 800;
    series_ = trajectory && program && evaluation
                  ? series_over_way(*trajectory, *program, *evaluation, columns)
                  : TrajectorySeries{};
}

void TimelinePanel::draw(Ui& ui, const Workbench& now, ActionQueue& ask) {
    refresh(now);
    widgets::TimelineView view;
    const std::array<widgets::TimelineSeries, 2> series{
        {{"error", "mm", series_.error, 0}, {"feed", "mm/min", series_.feed_mm_per_min, 0}}};
    if (!trajectory_) {
        view.permission = widgets::Permission::refused("There is no program yet.");
        (void)widgets::timeline(ui, "timeline", view);
        return;
    }
    view.series = series;
    const double way = trajectory_->part_length();
    view.fraction = way > 0.0 ? trajectory_->part_length_at(now.time()) / way : 0.0;
    view.is_playing = now.session.playback.playing;
    view.speed = now.session.playback.speed;
    view.block = now.block() + 1;
    view.blocks = trajectory_->block_count();
    view.time_s = now.time();
    view.total_s = trajectory_->duration();
    if (now.job.running) {
        view.permission = widgets::Permission::refused("The view follows the running job.");
    }
    if (const auto asked = widgets::timeline(ui, "timeline", view)) {
        obey(*asked, *trajectory_, ask);
    }
}

} // namespace millwright::panels
