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

/// A folder for results that are still being made: it is made at once, so that one that cannot be is told
/// before the work. Of it and its parents, those folders that were made and are empty at the end are removed,
/// also where only a part could be made; files and links never are.
class OutputFolder {
public:
    /// Throws Error if it cannot be made or is no folder.
    explicit OutputFolder(const std::filesystem::path& folder);
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;
    ~OutputFolder();

private:
    void remove_empty() const;

    std::vector<std::filesystem::path> made_; ///< the innermost first
};

/// Writes all beside their places first and renames them then. Throws Error, also where one of them would
/// replace `source`, a file that they were made from; what was there before then stays.
void write_outputs(const std::filesystem::path& folder,
                   const std::vector<OutputFile>& files,
                   const std::filesystem::path& source = {});

} // namespace millwright::app
