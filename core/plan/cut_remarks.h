// What a person should know of a cut beside its figures.
#pragma once

#include "core/plan/cut_study.h"
#include "core/plan/plan.h"
#include "core/project/project.h"

#include <optional>
#include <string>
#include <vector>

namespace millwright::plan {

/// How high at least what is left stands where the cutter never came near the surface, mm: farther up it is
/// not looked for, and ScallopFigures leave it out. Nothing where it came everywhere. `plan` has its study.
[[nodiscard]] std::optional<double> left_at_least(const Plan& plan);

/// "at most 0.0124 mm, 0.0031 mm on average, where 0.01 mm are wanted; 0.00 % not cut", or that it is at
/// least so much where it is not cut. `plan` has its study.
[[nodiscard]] std::string left_text(const project::Project& project, const Plan& plan);

/// "only this face was checked", with its number where the project has several.
[[nodiscard]] std::string checked_face_text(const project::Project& project);

/// What the figures of a cut were measured on, to stand beside each that says nothing was hit: "only this
/// face was checked ...", with its number where the project has several.
[[nodiscard]] std::string checked_text(const project::Project& project);

/// Why tracks of constant scallop leave more than they should, as a sentence with what to do; empty if they
/// do not, or if the program has others. `plan` has its study.
[[nodiscard]] std::string why_higher(const project::Project& project, const Plan& plan);

/// That the cutter does not keep the tolerance for which the fewest points were chosen, by `path`, the
/// program's; empty if it does, or if the program has others.
[[nodiscard]] std::string why_not_kept(const project::Project& project, const Evaluation& path);

/// That a spiral, which crosses the tracks for which the grid was made, runs over the uniform one, since that
/// is better for it; empty if it runs over the grid that was asked for, or the program has others.
[[nodiscard]] std::string crossing_remark(const project::Project& project, const Plan& plan);

/// In which figures the zigzag has more error than over the uniform grid, where the sequencing chooses its
/// way or adds points, of which the grid does not know; empty if in none.
[[nodiscard]] std::string sequencing_remark(const project::Project& project, const Plan& plan);

/// That no reason of a mixed weight has a share, so that it pulls nowhere; empty if one has, or if the weight
/// is another one.
[[nodiscard]] std::string weight_remark(const project::EllipticInput& input);

/// That the largest error of `path` is known within wider bounds than a thousandth of it; else empty.
[[nodiscard]] std::string certainty_remark(const Plan& plan, const Evaluation& path);

/// All of these that there are of the program of `plan` but why_higher(), as sentences.
[[nodiscard]] std::vector<std::string> path_remarks(const project::Project& project, const Plan& plan);

} // namespace millwright::plan
