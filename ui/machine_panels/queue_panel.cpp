#include "ui/machine_panels/queue_panel.h"

#include "ui/panels/fields.h"
#include "ui/widgets/icons.h"
#include "ui/widgets/notices.h"
#include "ui/widgets/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

namespace millwright::panels {

namespace {

namespace icons = widgets::icons;
using jobs::JobQueue;
using jobs::QueuedJob;
using jobs::QueuedJobId;
using jobs::QueueState;
using widgets::Permission;
using widgets::Rank;

/// Among those that wait; -1 where `id` does not.
int waiting_place(const FrameState& now, QueuedJobId id) {
    int place = 0;
    for (const QueuedJob& job : now.queue) {
        if (job.id == id) {
            return job.state == QueueState::waiting ? place : -1;
        }
        place += job.state == QueueState::waiting ? 1 : 0;
    }
    return -1;
}

int waiting_count(const FrameState& now) {
    return static_cast<int>(std::ranges::count(now.queue, QueueState::waiting, &QueuedJob::state));
}

std::string what_happened(const QueuedJob& job) {
    const bool unread = !job.has_program && job.state != QueueState::done;
    return job.sentence.empty() && unread ? "The program must be read again before the job runs."
                                          : job.sentence;
}

} // namespace

const QueuedJob* QueuePanel::chosen(const FrameState& now) const {
    const auto found = chosen_ ? std::ranges::find(now.queue, *chosen_, &QueuedJob::id) : now.queue.end();
    return found == now.queue.end() ? nullptr : &*found;
}

void QueuePanel::draw(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const auto scope = ui.scope("queue");
    if (now.queue_problem) {
        (void)widgets::banner(ui, "problem", {widgets::Severity::warning, to_text(*now.queue_problem), {}});
        if (ui.button(
                "retry", "Try again", {}, {icons::redo, Rank::quiet, -1.0F, "Read the queue file again"})) {
            ask.queue([](JobQueue&) {});
        }
        return;
    }
    draw_buttons(ui, now, ask);
    draw_table(ui, now);
}

namespace {

/// `job`: null if none is selected.
void open_button(Ui& ui, ActionQueue& ask, const QueuedJob* job, bool can_start) {
    const Permission can = job == nullptr ? Permission::refused("Select a job first.")
                           : can_start    ? Permission{}
                                          : Permission::refused("Only waiting or held jobs can be started.");
    if (ui.button(
            "open",
            "Open program",
            can,
            {{},
             Rank::normal,
             -1.0F,
             "Read the program of the job again for the connected machine. The machine does not move"})) {
        ask.open_queued(job->id);
    }
}

} // namespace

void QueuePanel::draw_buttons(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    const QueuedJob* job = chosen(now);
    const Permission none = Permission::refused("Select a job first.");
    const int place = job != nullptr ? waiting_place(now, job->id) : -1;
    const Permission waits = job == nullptr ? none
                             : place < 0    ? Permission::refused("Only waiting jobs can be moved.")
                                            : Permission{};
    const Permission removable = job == nullptr ? none
                                 : job->state == QueueState::running
                                     ? Permission::refused("The job is running.")
                                     : Permission{};
    const Permission held = job == nullptr                   ? none
                            : job->state == QueueState::held ? Permission{}
                                                             : Permission::refused("The job is not held.");
    const auto row = ui.row(8, ui.px(96.0F));
    action_button(ui, now, ask, catalogue_, "queue.run_next", Rank::primary, "Run next");
    action_button(ui, now, ask, catalogue_, "queue.add", Rank::normal, "Add program");
    const auto on_chosen = [&](std::string_view id,
                               std::string_view label,
                               const Permission& can,
                               std::string_view tip,
                               auto&& change) {
        if (ui.button(id, label, can, {{}, Rank::normal, -1.0F, tip})) {
            ask.queue([change, which = job->id](JobQueue& queue) { change(queue, which); });
        }
    };
    open_button(ui, ask, job, waits.allowed || held.allowed);
    on_chosen("earlier",
              "Move up",
              waits.allowed && place == 0 ? Permission::refused("This is the first waiting job.") : waits,
              "Move before the previous job",
              [to = place - 1](JobQueue& queue, QueuedJobId which) { queue.move(which, to); });
    on_chosen("later",
              "Move down",
              waits.allowed && place + 1 == waiting_count(now)
                  ? Permission::refused("This is the last waiting job.")
                  : waits,
              "Move after the next job",
              [to = place + 1](JobQueue& queue, QueuedJobId which) { queue.move(which, to); });
    on_chosen("release",
              "Release",
              held,
              "After inspecting the machine: return the job to the queue, to run from its start",
              [](JobQueue& queue, QueuedJobId which) { queue.release(which); });
    on_chosen("remove",
              "Remove",
              removable,
              "Remove the job from the queue",
              [](JobQueue& queue, QueuedJobId which) { queue.remove(which); });
    action_button(ui, now, ask, catalogue_, "queue.remove_done", Rank::normal, "Clear done");
}

void QueuePanel::draw_table(Ui& ui, const FrameState& now) {
    constexpr std::array<widgets::Column, 5> columns{{{"Job", "", 1.6F, false},
                                                      {"State", "", 0.8F, false},
                                                      {"Blocks", "", 0.8F, true},
                                                      {"From line", "", 0.8F, true},
                                                      {"Status", "", 5.0F, false}}};
    widgets::TableView view;
    view.columns = columns;
    view.rows = std::ssize(now.queue);
    view.cell = [&](std::ptrdiff_t row, int column) {
        const QueuedJob& job = now.queue[static_cast<std::size_t>(row)];
        const std::array<std::string, 5> cells{job.name,
                                               std::string(to_text(job.state)),
                                               fmt::format("{}", job.blocks),
                                               fmt::format("{}", job.from_line),
                                               what_happened(job)};
        return cells[static_cast<std::size_t>(column)];
    };
    view.row_id = [&](std::ptrdiff_t row) {
        return fmt::format("job{}", static_cast<int>(now.queue[static_cast<std::size_t>(row)].id));
    };
    const QueuedJob* job = chosen(now);
    view.chosen = job == nullptr ? -1 : job - now.queue.data();
    view.height = ui.rest().h;
    view.when_empty = "The queue is empty. \u201cAdd program\u201d adds the displayed program.";
    if (const auto row = widgets::table(ui, "jobs", view)) {
        chosen_ = now.queue[static_cast<std::size_t>(*row)].id;
    }
}

} // namespace millwright::panels
