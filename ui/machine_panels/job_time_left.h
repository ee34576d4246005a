// How long a job still takes. s.
#pragma once

#include "core/jobs/dispatcher.h"
#include "ui/panels/panel.h"

#include <optional>

namespace millwright::panels {

/// By the plan; nothing where there is none. May be below 0 where the machine is slower than its plan.
[[nodiscard]] std::optional<double> job_time_left(const FrameState& now, const jobs::JobReport& report);

} // namespace millwright::panels
