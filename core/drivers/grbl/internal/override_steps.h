// Overrides of Grbl 1.1, step by step. Grbl keeps the bytes that change them as flags, which it looks at once
// in each pass of its main loop: two equal bytes that come together count as one. So a step is sent when a
// report has shown the one before.
#pragma once

#include "core/drivers/driver_status.h"

#include <optional>
#include <string>

namespace millwright::drivers::grbl {

constexpr double stale_time = 0.5; ///< s in which a report may still tell of the time before a byte

class OverrideSteps {
public:
    /// The nearest that Grbl has: feed and spindle 10 to 200, rapid 100, 50 or 25 percent.
    void want(const Overrides& wanted);
    /// Nothing is wanted any more: after a reset, and at the end of a program.
    void forget();
    /// What a report says.
    void reported(const Overrides& now, double time);
    /// The bytes that are to be sent now; may be empty.
    [[nodiscard]] std::string take_step(double time);

    /// As last reported.
    [[nodiscard]] const Overrides& now() const { return now_; }
    [[nodiscard]] bool under_way() const { return wanted_.has_value(); }

private:
    Overrides now_;
    std::optional<Overrides> wanted_; ///< until a report shows it
    Overrides expected_;              ///< after the step that was sent last
    double sent_ = -1.0;              ///< when; negative: no step waits for its report
};

} // namespace millwright::drivers::grbl
