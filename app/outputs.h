// Several files that belong together, in a folder: all of them are replaced or none.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace millwright::app {

struct OutputFile {
    std::string name;
    std::string bytes;
};

/// Writes all beside their places first and renames them then. Throws Error, also where one of them would
/// replace `source`, a file that they were made from; what was there before then stays.
void write_outputs(const std::filesystem::path& folder,
                   const std::vector<OutputFile>& files,
                   const std::filesystem::path& source = {});

} // namespace millwright::app
