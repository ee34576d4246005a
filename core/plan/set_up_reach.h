// Why the machine does not cut a part in its present place, or anywhere near.
#pragma once

#include "core/plan/set_up_study.h"

#include <optional>
#include <string>

namespace millwright::plan {

/// The first point of the path over the study's grid that the machine does not reach with the part at
/// `place`, with the axis and its limits; nothing where it reaches all. Throws Error where the surface has no
/// normal at a node.
[[nodiscard]] std::optional<std::string> why_out_of_reach(const CuttingSetup& cutting_setup,
                                                          const SetUpStudySettings& settings,
                                                          const toolpath::SetUpPlace& place);

/// Throws Error if the best place that was found in `within` is out of reach: with what was searched, and the
/// reason where the part stands.
void expect_in_reach(const toolpath::SetUpSearch& search,
                     const CuttingSetup& cutting_setup,
                     const SetUpStudySettings& settings,
                     const toolpath::SetUpSearchSettings& within);

} // namespace millwright::plan
