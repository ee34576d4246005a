// What makes a program unfit to be run: cutter or holder in the part beyond what the tool allows.
#pragma once

#include "core/plan/cut_study.h"
#include "core/project/project.h"

#include <string>

namespace millwright::plan {

/// "the cutter goes up to 10.2421 mm below the surface, where 0.1 mm are allowed (163 blocks, the deepest in
/// line 47)", and the same of the holder, with checked_text(); empty if no block of the program gouges the
/// part.
[[nodiscard]] std::string gouge_text(const project::Project& project, const CutStudy& cut);

} // namespace millwright::plan
