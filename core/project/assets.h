// What ships with the program, and where it is found: machines and sample projects.
#pragma once

#include "core/project/project.h"

#include <filesystem>
#include <string>
#include <vector>

namespace millwright::project {

/// The folder of what ships with the program: $MILLWRIGHT_ASSETS, else assets/ or share/millwright/assets/
/// beside or above the executable, else the source tree's. Throws Error if there is none.
[[nodiscard]] std::filesystem::path assets_folder();

/// Where assets_folder looks.
struct AssetsSearch {
    std::filesystem::path named;      ///< by the user; nothing else is tried unless empty
    std::filesystem::path executable; ///< its folder and those above it are searched
    std::filesystem::path fallback;   ///< empty: none
};
[[nodiscard]] std::filesystem::path assets_folder(const AssetsSearch& search);

/// The machine file that `project` names: an id (no '/', no '.') is looked up in `assets`/machines, a path is
/// taken relative to the project file's folder. Throws Error naming the known ids if there is none.
[[nodiscard]] std::filesystem::path machine_path(const Project& project,
                                                 const std::filesystem::path& project_folder,
                                                 const std::filesystem::path& assets);

/// The same for any `name`; a path is taken relative to `folder`.
[[nodiscard]] std::filesystem::path machine_path(const std::string& name,
                                                 const std::filesystem::path& folder,
                                                 const std::filesystem::path& assets);

/// Ids of the shipped machines, in order.
[[nodiscard]] std::vector<std::string> machine_ids(const std::filesystem::path& assets);

/// The post file that `name` means: an id (no '/', no '.') is looked up in `assets`/posts, a path is taken
/// relative to `folder`. Throws Error naming the known ids if there is none.
[[nodiscard]] std::filesystem::path
post_path(const std::string& name, const std::filesystem::path& folder, const std::filesystem::path& assets);
/// The same for arms, shipped in `assets`/arms.
[[nodiscard]] std::filesystem::path
arm_path(const std::string& name, const std::filesystem::path& folder, const std::filesystem::path& assets);

/// Ids of the shipped arms, in order.
[[nodiscard]] std::vector<std::string> arm_ids(const std::filesystem::path& assets);

/// Ids of the shipped posts, in order.
[[nodiscard]] std::vector<std::string> post_ids(const std::filesystem::path& assets);

/// The shipped sample projects, in order of their names.
[[nodiscard]] std::vector<std::filesystem::path> sample_projects(const std::filesystem::path& assets);

} // namespace millwright::project
