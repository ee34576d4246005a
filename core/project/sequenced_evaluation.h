// A grid carried to its error with the rotary axes chosen for the whole path.
#pragma once

#include "core/project/plan.h"
#include "core/toolpath/sequenced_path.h"

namespace millwright::project {

/// evaluate() with the branches, turns and further points of `sequencing`. Throws Error also where the
/// workpiece's angles are not the consistent ones.
[[nodiscard]] Evaluation evaluate(const Workpiece& workpiece,
                                  GridOutcome outcome,
                                  const toolpath::SequencingSettings& sequencing,
                                  int samples,
                                  const Progress& progress);

/// Of the project's chosen grid the path, its error and the program anew. Throws Error or Cancelled, then
/// `plan` is as it was.
void sequence_program(Plan& plan,
                      const Project& project,
                      const toolpath::SequencingSettings& sequencing,
                      const Progress& progress);

} // namespace millwright::project
