#include "ui/workspaces/stock_workspace.h"

#include "core/base/error.h"
#include "core/simulation/spec_text.h"
#include "ui/workspaces/frame_state.h"
#include "ui/workspaces/view_state.h"

#include <algorithm>

namespace millwright::actions {

namespace {

/// Nothing for a mesh, which would have to be read, and for a text with a fault.
std::optional<simulation::Stock> quick_stock(const geometry::Surface& surface,
                                             const plan::StockSettings& settings) {
    if (settings.stock.empty()) {
        return plan::stock_around(surface, settings.allowance).stock;
    }
    try {
        auto stock = simulation::parse_stock(settings.stock).stock;
        return stock && simulation::fault_of(*stock).empty() ? stock : std::nullopt;
    } catch (const Error&) { // the field that has the text says what is wrong with it
        return std::nullopt;
    }
}

bool is_other_stock(const plan::StockResult* seen, const plan::StockResult& now) {
    return !seen || seen->job.surface != now.job.surface || seen->stock_text != now.stock_text;
}

/// What is of another program than the project's can never be shown again.
void follow_program(plan::StockWorker& worker, const FrameState& now, ViewState& view_state) {
    const auto planned = now.plan ? now.plan->plan.program : nullptr;
    const plan::Activity work = worker.activity();
    if (work.busy && !work.stopping && worker.requested() != planned) {
        worker.cancel();
        tell(view_state,
             widgets::Severity::info,
             "Simulation cancelled: the program has changed. Simulate again.");
    }
    if (const auto result = worker.view().result; result && result->job.program != planned) {
        worker.release();
    }
}

} // namespace

void StockWorkspace::simulate(const FrameState& now) {
    const plan::Plan& plan = now.plan->plan;
    worker_.request({.project = now.plan->project,
                     .surface = plan.surface,
                     .cutting_setup = plan.cutting_setup,
                     .program = plan.program,
                     .listing = plan.listing,
                     .machine_solids = now.machine_solids,
                     .settings = now.view_state.stock.wanted()});
}

void StockWorkspace::follow_forecast(const FrameState& now) {
    const auto surface = now.plan ? now.plan->plan.surface : nullptr;
    const plan::StockSettings settings = now.view_state.stock.wanted();
    const bool same = surface == surface_ && settings.stock == settings_.stock &&
                      settings.resolution == settings_.resolution &&
                      !(settings.allowance < settings_.allowance) &&
                      !(settings.allowance > settings_.allowance);
    if (same) {
        return;
    }
    surface_ = surface;
    settings_ = settings;
    const auto stock = surface ? quick_stock(*surface, settings) : std::nullopt;
    forecast_ = stock ? std::optional(plan::forecast_of(*stock, settings.resolution)) : std::nullopt;
}

void StockWorkspace::follow_comparison(double tolerance) {
    const auto& result = view_.result;
    if (result == compared_ && !(tolerance < tolerance_ || tolerance > tolerance_)) {
        return;
    }
    compared_ = result;
    tolerance_ = tolerance;
    comparison_ = result
                      ? std::optional(simulation::summary_of(result->points, result->deviations, tolerance))
                      : std::nullopt;
}

void StockWorkspace::follow(const FrameState& now, ViewState& view_state) {
    follow_program(worker_, now, view_state);
    view_ = worker_.view();
    follow_forecast(now);
    follow_comparison(now.view_state.stock.settings.tolerance);
    if (!stock_is_current(now)) {
        return;
    }
    if (view_.result != seen_) {
        if (view_.picture || view_.picture_failure) {
            if (view_state.stock.shown && is_other_stock(seen_.get(), *view_.result)) {
                view_state.fit_wanted_in(Workspace::toolpath) = true; // it is larger than the part
                view_state.fit_wanted_in(Workspace::program) = true;
            }
            seen_ = view_.result;
        }
        if (!now.follows_job()) {
            view_state.playback.playing = false;
            view_state.playback.time = now.duration();
        }
    }
    worker_.show(executed_blocks(now));
}

bool stock_is_current(const FrameState& now) {
    const auto& result = now.stock.view().result;
    return result && !now.in_file() && result->job.program == now.program();
}

int executed_blocks(const FrameState& now) {
    const auto program = now.program();
    if (!program) {
        return 0;
    }
    return now.time() < now.duration() ? std::max(now.block(), 0) : program->block_count();
}

void go_to_block(const FrameState& now, ViewState& view_state, int block, double fraction) {
    const auto trajectory = now.trajectory();
    if (trajectory && !now.follows_job() && block >= 0) {
        view_state.playback.playing = false;
        view_state.playback.time = trajectory->time_at(block, fraction);
    }
}

} // namespace millwright::actions
