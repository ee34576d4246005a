// A program executed from reset to its end on a processor of its own, beside the one that is stepped: its
// beginning at once, so that what follows a dragging hand moves, the rest of a long one in the background.
#pragma once

#include "core/cordic/run_report.h"
#include "core/cordic_control/stitch_timing.h"
#include "ui/workspaces/latest_work.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace millwright::actions {

/// What a run is measured against.
struct RunTerms {
    double clock_hz = 8e6;      ///< > 0
    double needle_rpm = 3000.0; ///< > 0
};

class WholeRun {
public:
    static constexpr std::int64_t clocks_at_once = 1'000'000; ///< 30 ms
    static constexpr std::int64_t most_clocks = cordic::usual_most_clocks;

    /// `wake`: from any thread, when more is known.
    explicit WholeRun(std::function<void()> wake);

    /// Executes another program. `processor` is after reset, `expected` what it is to publish.
    void begin(const cordic::Processor& processor, std::vector<cordic::ExactPoint> expected, RunTerms terms);
    void judge(RunTerms terms); ///< the same run
    void clear();

    [[nodiscard]] const cordic::RunReport& report() const { return known_->report; }
    [[nodiscard]] const cordic::StitchTiming& sewing() const { return known_->sewing; }
    [[nodiscard]] std::span<const cordic::PathDifference> differences() const { return known_->differences; }

    [[nodiscard]] bool goes_on() const { return goes_on_; } ///< in the background: what is known is a part
    /// Takes what was found in the background. True if there was anything.
    bool take();
    void wait_idle() const { rest_->wait_idle(); }

private:
    using Expected = std::shared_ptr<const std::vector<cordic::ExactPoint>>;
    struct Wish {
        std::shared_ptr<const cordic::Processor> from;
        Expected expected;
        RunTerms terms;
    };
    struct Answer {
        std::shared_ptr<const cordic::Processor> processor; ///< behind the run
        cordic::RunReport report;
        cordic::StitchTiming sewing;
        std::vector<cordic::PathDifference> differences;
    };
    static Answer judged(const Wish& wish);
    static Answer run_on(const Wish& wish, const Progress& progress);

    Expected expected_;
    std::shared_ptr<const Answer> known_; ///< never null
    bool goes_on_ = false;
    std::unique_ptr<LatestWork<Wish, Answer>> rest_; ///< never null
};

} // namespace millwright::actions
