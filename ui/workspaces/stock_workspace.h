// The simulation of the stock: starts it, keeps it at the block that is shown, and says what it would take.
#pragma once

#include "core/plan/file_setup.h"
#include "core/plan/stock_work.h"
#include "core/simulation/deviation_histogram.h"
#include "ui/viewport/stock_section.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace millwright::actions {

struct FrameState;
struct ViewState;

/// Of a G-code file, which has neither stock nor tools in it.
struct FileStock {
    std::filesystem::path file; ///< that this is of
    std::string stock;          ///< as core/simulation/spec_text.h has it; empty: not known
    plan::ToolTexts tools;
};

/// What a person chooses of it.
struct StockChoice {
    plan::StockSettings settings; ///< but for stock and allowance, which are the project's, or the file's
    FileStock file;
    std::vector<FileStock>
        set_aside;     ///< of what else is open: the file while a plot is shown, or the other way round
    bool shown = true; ///< what is left, in place of the surface
    viewport::StockSection section;
    bool sectioned = false; ///< what lies beyond `section` is taken away
};

class StockWorkspace {
public:
    /// `wake` is called from other threads when something new can be looked at.
    explicit StockWorkspace(const std::function<void()>& wake) : worker_(wake) {}

    /// Of the program that is shown, as project and view state say. Throws Error for a file whose tools are
    /// not known.
    void simulate(const FrameState& now);
    void cancel() { worker_.cancel(); }
    /// Once per frame: the forecast of what is chosen, and the picture of the block that is shown. A new
    /// result is shown at the end of the program; of a new stock the views are fitted to it. What is of a
    /// program that has changed since ends, and gives its memory back.
    void follow(const FrameState& now, ViewState& view_state);

    /// As it was at the last follow(): all that one frame shows is of one result.
    [[nodiscard]] const plan::StockView& view() const { return view_; }
    [[nodiscard]] plan::Activity activity() const { return worker_.activity(); }
    /// Of what is chosen, worked out in the background. Nothing where the surface is not there yet, or the
    /// stock cannot be read.
    [[nodiscard]] const std::optional<plan::StockForecast>& forecast() const { return view_.forecast; }
    /// Of the result, by the tolerance that is chosen now; nothing without a part.
    [[nodiscard]] const std::optional<simulation::ComparisonSummary>& comparison() const {
        return comparison_;
    }
    /// Of the same; without bins where there is no comparison.
    [[nodiscard]] const simulation::DeviationHistogram& histogram() const { return histogram_; }
    /// Whether another simulation would be made by other settings, or by other tools of a file.
    [[nodiscard]] bool is_outdated(const FrameState& now) const;
    /// Writes what is shown. Throws Error.
    void export_cut(const std::filesystem::path& file, double tolerance) const;
    void wait_idle() const { worker_.wait_idle(); }

private:
    void follow_forecast(const FrameState& now);
    void follow_comparison(double tolerance);

    /// What the forecast was made for.
    std::shared_ptr<const geometry::Surface> surface_;
    plan::StockSettings settings_;
    bool asked_ = false;
    plan::StockView view_;
    std::shared_ptr<const plan::StockResult> seen_, compared_;
    plan::ToolTexts asked_tools_, used_tools_; ///< of a file: of the last request, of the result
    double tolerance_ = 0.0;                   ///< of the comparison
    std::optional<simulation::ComparisonSummary> comparison_;
    simulation::DeviationHistogram histogram_;
    plan::StockWorker worker_; // last: its threads end first
};

/// With the stock of the program that is shown: of the project, or of the opened file.
[[nodiscard]] plan::StockSettings wanted_stock(const FrameState& now);
/// The result is of the program that is shown: neither the project nor the tool has changed since.
[[nodiscard]] bool stock_is_current(const FrameState& now);
/// Blocks that have been executed where the timeline is; while it follows a whole job, those that the machine
/// has executed, or was sent where it does not answer.
[[nodiscard]] int executed_blocks(const FrameState& now);
/// From there on the timeline goes, unless it follows a job.
void go_to_block(const FrameState& now, ViewState& view_state, int block, double fraction);

} // namespace millwright::actions
