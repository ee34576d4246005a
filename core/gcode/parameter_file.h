// LinuxCNC's parameter file (*.var): what a controller remembers, offsets and reference points above all. One
// parameter a line, its number and its value; lengths are in the machine's unit.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>
#include <utility>
#include <vector>

namespace millwright::gcode {

using Parameters = std::vector<std::pair<int, double>>;

/// Throws Error with the line for anything that is no parameter, and for one that stands there twice.
[[nodiscard]] Parameters parse_parameter_file(std::string_view text, const std::filesystem::path& file);

/// Bytes: of 5600 parameters, a line each.
inline constexpr std::size_t largest_parameter_file = std::size_t{4} << 20U;

/// Throws Error also if `file` cannot be read, or is larger.
[[nodiscard]] Parameters read_parameter_file(const std::filesystem::path& file);

} // namespace millwright::gcode
