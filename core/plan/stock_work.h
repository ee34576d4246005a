// A simulation of the stock in the background, and its pictures along the timeline.
#pragma once

#include "core/base/error.h"
#include "core/plan/pipeline.h"
#include "core/plan/stock_simulation.h"

#include <functional>
#include <memory>
#include <optional>

namespace millwright::plan {

/// What there is of a simulation now. Both null before the first.
struct StockView {
    std::shared_ptr<const StockResult> result;
    std::shared_ptr<const StockPicture> picture; ///< the newest, of `result`
    std::optional<Diagnostic> failure;           ///< why the last one ended without a result
    std::optional<Diagnostic> picture_failure;   ///< why there is no newer picture
    std::optional<StockForecast> forecast; ///< of what was asked for last; nullopt: not known yet, or never
};

/// One simulation at a time, on a thread of its own. Called from the owner's thread; every member but
/// wait_idle returns at once.
class StockWorker {
public:
    /// `wake` is called from the worker whenever something new can be looked at.
    explicit StockWorker(std::function<void()> wake);
    StockWorker(const StockWorker&) = delete;
    StockWorker& operator=(const StockWorker&) = delete;
    ~StockWorker();

    /// What runs is dropped; what was found last stays until the new result is there.
    void request(StockJob job);
    /// What was found last stays.
    void cancel();
    /// Drops the picture, and what further ones would be made of, with its memory. The result stays.
    void release();
    /// From now on the picture is of what the blocks before `block` have left of the last result.
    void show(int block);

    /// Works out what a simulation would take, in the background: StockView::forecast. What is known of an
    /// earlier one stays until then. `surface`: of the box around the part; may be null for other stocks.
    void forecast(std::shared_ptr<const geometry::Surface> surface, StockSettings settings);

    /// The program of the job that came last; null before the first.
    [[nodiscard]] std::shared_ptr<const program::Program> requested() const;
    [[nodiscard]] StockView view() const;
    /// Of a simulation; a picture takes a moment only.
    [[nodiscard]] Activity activity() const;
    void wait_idle() const;

private:
    class Worker;
    std::unique_ptr<Worker> worker_;
};

} // namespace millwright::plan
