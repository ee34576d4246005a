#include "ui/workspaces/stock_workspace.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "core/plan/part_stock.h"
#include "core/simulation/spec_text.h"
#include "ui/workspaces/frame_state.h"
#include "ui/workspaces/stock_file.h"
#include "ui/workspaces/view_state.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace millwright::actions {

namespace {

bool is_other_stock(const plan::StockResult* seen, const plan::StockResult& now) {
    return !seen || seen->job.surface != now.job.surface || seen->stock_text != now.stock_text;
}

bool is_program_of(const std::shared_ptr<const plan::OpenedProgram>& opened,
                   const std::shared_ptr<const program::Program>& program) {
    return opened && opened->motion && opened->motion->program == program;
}

bool is_file_of(const std::shared_ptr<const plan::OpenedProgram>& opened, const std::filesystem::path& file) {
    return opened && opened->file == file;
}

/// Of the project, of the opened file, or of the plot, whichever is looked at.
bool is_there(const FrameState& now, const std::shared_ptr<const program::Program>& program) {
    return (now.plan && now.plan->plan.program == program) || is_program_of(now.opened_file, program) ||
           is_program_of(now.opened, program) || is_program_of(now.plot.opened(), program);
}

/// What is of a program that is gone can never be shown again.
void follow_program(plan::StockWorker& worker, const FrameState& now, ViewState& view_state) {
    const plan::Activity work = worker.activity();
    if (work.busy && !work.stopping && !is_there(now, worker.requested())) {
        worker.cancel();
        tell(view_state,
             widgets::Severity::info,
             "Simulation cancelled: the program has changed. Simulate again.");
    }
    if (const auto result = worker.view().result; result && !is_there(now, result->job.program)) {
        worker.release();
    }
}

/// A file that is new begins with the box around its path, and without tools.
void follow_file(const FrameState& now, StockChoice& choice) {
    if (!now.in_file() || !now.opened->motion || choice.file.file == now.opened->file) {
        return;
    }
    std::vector<FileStock>& aside = choice.set_aside;
    aside.push_back(std::move(choice.file));
    const auto found = std::ranges::find(aside, now.opened->file, &FileStock::file);
    choice.file =
        found != aside.end() ? *found : FileStock{now.opened->file, plan::suggested_stock(*now.opened), {}};
    std::erase_if(aside, [&](const FileStock& one) {
        return one.file == now.opened->file ||
               !(is_file_of(now.opened_file, one.file) || is_file_of(now.plot.opened(), one.file));
    });
}

} // namespace

plan::StockSettings wanted_stock(const FrameState& now) {
    plan::StockSettings wanted = now.view_state.stock.settings;
    const project::StockInput& input = now.project.stock;
    wanted.allowance = input.allowance_mm;
    if (now.in_file()) {
        const FileStock& file = now.view_state.stock.file;
        wanted.stock = file.file == now.opened->file ? file.stock : std::string();
    } else {
        wanted.stock = input.around_part ? std::string() : plan::stock_text(input);
    }
    return wanted;
}

void StockWorkspace::simulate(const FrameState& now) {
    plan::StockJob job;
    job.settings = wanted_stock(now);
    if (now.in_file()) {
        job.file = plan::file_setup(*now.opened, now.view_state.stock.file.tools);
        asked_tools_ = now.view_state.stock.file.tools;
        job.program = now.opened->motion->program;
        job.listing = now.opened->motion->listing;
    } else {
        const plan::Plan& plan = now.plan->plan;
        job.project = now.plan->project;
        job.surface = plan.surface;
        job.cutting_setup = plan.cutting_setup;
        job.program = plan.program;
        job.listing = plan.listing;
        job.machine_solids = now.machine_solids;
    }
    worker_.request(std::move(job));
}

void StockWorkspace::follow_forecast(const FrameState& now) {
    const auto surface = now.plan && !now.in_file() ? now.plan->plan.surface : nullptr;
    plan::StockSettings settings = wanted_stock(now);
    settings.tolerance = settings_.tolerance; // neither counts for it
    settings.clearance = settings_.clearance;
    if (asked_ && surface == surface_ && settings == settings_) {
        return;
    }
    asked_ = true;
    surface_ = surface;
    settings_ = settings;
    worker_.forecast(surface, settings);
}

void StockWorkspace::follow_comparison(double tolerance) {
    const auto& result = view_.result;
    if (result == compared_ && !(tolerance < tolerance_ || tolerance > tolerance_)) {
        return;
    }
    compared_ = result;
    tolerance_ = tolerance;
    if (!result || result->points.empty()) {
        comparison_.reset();
        histogram_ = {};
        return;
    }
    comparison_ = simulation::summary_of(result->points, result->deviations, tolerance);
    constexpr int bins = 40;
    histogram_ = simulation::histogram_of(
        result->points, result->deviations, simulation::histogram_range(result->deviations, tolerance), bins);
}

void StockWorkspace::follow(const FrameState& now, ViewState& view_state) {
    follow_program(worker_, now, view_state);
    follow_file(now, view_state.stock);
    const auto before = view_.result;
    view_ = worker_.view();
    if (view_.result != before) {
        used_tools_ = asked_tools_;
    }
    follow_forecast(now);
    follow_comparison(now.view_state.stock.settings.tolerance);
    if (!stock_is_current(now)) {
        return;
    }
    if (view_.result != seen_) {
        if (view_.picture || view_.picture_failure) {
            if (view_state.stock.shown && is_other_stock(seen_.get(), *view_.result)) {
                view_state.fit_wanted_in(Workspace::program) = true; // it is larger than the part
                view_state.fit_wanted_in(Workspace::toolpath) |= !view_.result->job.file;
            }
            seen_ = view_.result;
        }
        if (!now.follows_job()) {
            view_state.playback.playing = false;
            view_state.playback.time = now.duration();
            view_state.file.step.reset(); // the motion says where one is
        }
    }
    worker_.show(executed_blocks(now));
}

bool StockWorkspace::is_outdated(const FrameState& now) const {
    if (!view_.result) {
        return false;
    }
    const plan::StockJob& job = view_.result->job;
    return !plan::give_the_same(job.settings, wanted_stock(now)) ||
           (job.file && used_tools_ != now.view_state.stock.file.tools);
}

void StockWorkspace::export_cut(const std::filesystem::path& file, double tolerance) const {
    if (!view_.picture) {
        throw Error("nothing has been simulated", file, "simulate first");
    }
    write_file(file, stock_file_bytes(*view_.picture, tolerance, file));
}

bool stock_is_current(const FrameState& now) {
    const auto& result = now.stock.view().result;
    return result && result->job.program == now.program();
}

int executed_blocks(const FrameState& now) {
    const auto program = now.program();
    if (!program) {
        return 0;
    }
    const auto listing = now.in_file() ? now.opened->motion->listing : now.listing();
    if (now.follows_job() && now.job.from_line <= 1 && now.job.listing && listing &&
        now.job.listing->text == listing->text) {
        return std::clamp(now.job.report->driver.executed_blocks, 0, program->block_count());
    }
    return now.time() < now.duration() ? std::max(now.block(), 0) : program->block_count();
}

void go_to_block(const FrameState& now, ViewState& view_state, int block, double fraction) {
    const auto trajectory = now.trajectory();
    if (trajectory && !now.follows_job() && block >= 0) {
        view_state.playback.playing = false;
        view_state.playback.time = trajectory->time_at(block, fraction);
        view_state.file.step.reset(); // the motion says where one is
    }
}

} // namespace millwright::actions
