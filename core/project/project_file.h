// Project files: JSON with a format number, described field by field in docs/reference/project-file.md.
#pragma once

#include "core/project/project.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace millwright::project {

/// Throws Error with file, line and field for anything wrong in it.
[[nodiscard]] Project read_project(const std::filesystem::path& file);

/// Deterministic bytes. Throws Error if it cannot be written or would not be read again (faults_of); the old
/// file then stays as it was.
void write_project(const Project& project, const std::filesystem::path& file);

/// Throws Error with the first of faults_of(project) if there is one.
[[nodiscard]] std::string project_text(const Project& project);
/// `named` stands in diagnostics.
[[nodiscard]] Project project_from_text(std::string_view text, const std::filesystem::path& named);

<<<<<<< HEAD
/// The machine file that `project` names: an id is looked up in `assets`/machines, a path is taken relative
/// to the project file's folder. Throws Error naming the known ids if there is none.
[[nodiscard]] std::filesystem::path machine_path(const Project& project,
                                                 const std::filesystem::path& project_folder,
                                                 const std::filesystem::path& assets);

/// The folder of what ships with the program: $MILLWRIGHT_ASSETS, else assets/ beside or above the
/// executable, else the source tree's. Throws Error if none is there.
[[nodiscard]] std::filesystem::path assets_folder();

=======
>>>>>>> 170fdd3 (Project room: project files with every fault placed, settings that describe themselves, undo, shipped assets)
} // namespace millwright::project
