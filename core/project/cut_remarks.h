// What a person should know of a cut beside its figures.
#pragma once

#include "core/project/cut_study.h"
#include "core/project/plan.h"
#include "core/project/project.h"

#include <string>

namespace millwright::project {

/// Why tracks of constant scallop leave more than they should, as a sentence with what to do; empty if they
/// do not, or if the program has others. `plan` has its study.
[[nodiscard]] std::string why_higher(const Project& project, const Plan& plan);

} // namespace millwright::project
