// The simulation of the stock: starts it, keeps it at the block that is shown, and says what it would take.
#pragma once

#include "core/plan/stock_work.h"

#include <functional>
#include <memory>
#include <optional>

namespace millwright::actions {

struct FrameState;
struct ViewState;

/// What a person chooses of it. The box around the part, or a stock by its text.
struct StockChoice {
    plan::StockSettings settings; ///< without a stock where that is the box
    std::string text = "box:100,100,20@-50,-50,-20";
    bool by_text = false;
    bool shown = true; ///< what is left, in place of the surface

    /// With the stock that is chosen.
    [[nodiscard]] plan::StockSettings wanted() const {
        plan::StockSettings all = settings;
        all.stock = by_text ? text : std::string();
        return all;
    }
};

class StockWorkspace {
public:
    /// `wake` is called from other threads when something new can be looked at.
    explicit StockWorkspace(const std::function<void()>& wake) : worker_(wake) {}

    /// Of the project's program, as the view state says.
    void simulate(const FrameState& now);
    void cancel() { worker_.cancel(); }
    /// Once a frame: the forecast of what is chosen, and the picture of the block that is shown. A new result
    /// is shown at the end of the program; of a new stock the views are fitted to it. What is of a program
    /// that has changed since ends, and gives its memory back.
    void follow(const FrameState& now, ViewState& view_state);

    /// As it was at the last follow(): all that one frame shows is of one result.
    [[nodiscard]] const plan::StockView& view() const { return view_; }
    [[nodiscard]] plan::Activity activity() const { return worker_.activity(); }
    /// Nothing where the surface is not there yet, the stock's text is wrong, or it is a mesh.
    [[nodiscard]] const std::optional<plan::StockForecast>& forecast() const { return forecast_; }
    /// Of the result, by the tolerance that is chosen now; nothing without one.
    [[nodiscard]] const std::optional<simulation::ComparisonSummary>& comparison() const {
        return comparison_;
    }
    void wait_idle() const { worker_.wait_idle(); }

private:
    void follow_forecast(const FrameState& now);
    void follow_comparison(double tolerance);

    /// What the forecast was made for.
    std::shared_ptr<const geometry::Surface> surface_;
    plan::StockSettings settings_;
    std::optional<plan::StockForecast> forecast_;
    plan::StockView view_;
    std::shared_ptr<const plan::StockResult> seen_, compared_;
    double tolerance_ = 0.0; ///< of the comparison
    std::optional<simulation::ComparisonSummary> comparison_;
    plan::StockWorker worker_; // last: its threads end first
};

/// The result is of the program that is shown: neither the project nor the tool has changed since.
[[nodiscard]] bool stock_is_current(const FrameState& now);
/// Blocks that have been executed where the timeline is.
[[nodiscard]] int executed_blocks(const FrameState& now);
/// From there on the timeline goes, unless it follows a job.
void go_to_block(const FrameState& now, ViewState& view_state, int block, double fraction);

} // namespace millwright::actions
