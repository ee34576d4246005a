// Project files: JSON with a format number, described field by field in docs/reference/project-file.md.
#pragma once

#include "core/project/project.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace millwright::project {

/// Throws Error with file, line and field for anything wrong in it. The file of its plot is taken from beside
/// `file`.
[[nodiscard]] Project read_project(const std::filesystem::path& file);

/// Returns the bytes that it writes, which are deterministic. A plot beside `file` or below is named from
/// there. Throws Error if it cannot be written or would not be read again (faults_of); the old file then
/// stays as it was.
std::string write_project(const Project& project, const std::filesystem::path& file);

/// Throws Error with the first of faults_of(project) if there is one.
[[nodiscard]] std::string project_text(const Project& project);
/// `named` stands in diagnostics, and names of files start from its folder.
[[nodiscard]] Project project_from_text(std::string_view text, const std::filesystem::path& named);

} // namespace millwright::project
