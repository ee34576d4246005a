// What a .json file is for: projects are not the only ones.
#pragma once

#include <filesystem>
#include <string_view>

namespace millwright::project {

/// "project", "arm", "taught points", "machine", "tool", "recent files" ...: by the format that its beginning
/// names, else by the form of the lists that Millwright keeps for itself; "JSON" for any other. Empty for a
/// file that does not end in .json. A file that cannot be read is "JSON".
[[nodiscard]] std::string_view json_kind(const std::filesystem::path& file);

[[nodiscard]] bool is_project_json(const std::filesystem::path& file);
[[nodiscard]] bool is_arm_json(const std::filesystem::path& file);
[[nodiscard]] bool is_taught_points_json(const std::filesystem::path& file);

} // namespace millwright::project
