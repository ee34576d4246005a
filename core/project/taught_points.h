// Points taught to an arm as a file of their own, to be taken from one project to another.
// docs/reference/arm.md tells the format.
#pragma once

#include "core/project/arm_input.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::project {

/// Throws Error with the place of what is wrong.
[[nodiscard]] std::vector<TaughtPoint> read_taught_points(const std::filesystem::path& file);
[[nodiscard]] std::vector<TaughtPoint> taught_points_from_text(std::string_view text,
                                                               const std::filesystem::path& named);

[[nodiscard]] std::string taught_points_text(const std::vector<TaughtPoint>& points);
/// Throws Error if the file cannot be written; an old one then stays as it was.
void write_taught_points(const std::vector<TaughtPoint>& points, const std::filesystem::path& file);

/// What is wrong with them, as sentences; empty if nothing is.
[[nodiscard]] std::vector<std::string> faults_of(const std::vector<TaughtPoint>& points);

/// "Point 3": the first that no point is called.
[[nodiscard]] std::string free_point_name(const std::vector<TaughtPoint>& points);

} // namespace millwright::project
