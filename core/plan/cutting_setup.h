// Surface, machine, tool and direction of a project as its plan takes them.
#pragma once

#include "core/plan/evaluation.h"
#include "core/project/project.h"

#include <filesystem>

namespace millwright::plan {

/// Where the project's machine is looked for.
struct Folders {
    std::filesystem::path project; ///< of the project file; empty for an unsaved project
    std::filesystem::path assets;

    friend bool operator==(const Folders&, const Folders&) = default;
};

/// Throws Error with the first of faults_of(project) if there are any.
void refuse_faults(const project::Project& project);

/// Throws Error if the machine is unknown or its file wrong, or joined faces cannot be joined.
[[nodiscard]] CuttingSetup cutting_setup_of(const project::Project& project, const Folders& folders);
/// The same with the project's region at hand.
[[nodiscard]] CuttingSetup
cutting_setup_of(const project::Project& project, const Folders& folders, region::Region patch);

/// How the axis positions of its paths are chosen; what does not matter for the goal is left out, so that
/// equal settings give equal paths.
[[nodiscard]] toolpath::SequencingSettings sequencing_settings(const project::Project& project);
/// The program that SequencingGoal::time is about; with another goal always the same.
[[nodiscard]] project::ProgramInput timing(const project::Project& project);

} // namespace millwright::plan
