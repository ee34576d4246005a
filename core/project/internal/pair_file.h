// Small files of the user's that keep texts by name: a JSON list of objects with two members each.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace millwright::project {

/// What the two members are called.
struct PairNames {
    std::string_view name;
    std::string_view value;
};

/// Empty where there is no file. Throws Error with its place for anything but such a list.
[[nodiscard]] std::map<std::string, std::string> read_pairs(const std::filesystem::path& file,
                                                            const PairNames& names);

/// Makes the folder where missing. Throws Error where the file cannot be written.
void write_pairs(const std::map<std::string, std::string>& pairs,
                 const std::filesystem::path& file,
                 const PairNames& names);

} // namespace millwright::project
