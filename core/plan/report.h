// report.json: what a plan promises, for people and programs. Fields: docs/reference/report.md.
#pragma once

#include "core/plan/plan.h"

#include <string>

namespace millwright::plan {

/// Deterministic text. Lengths mm, angles deg, times s. Throws Defect if the plan is not complete.
[[nodiscard]] std::string report_text(const project::Project& project, const Plan& plan);

} // namespace millwright::plan
