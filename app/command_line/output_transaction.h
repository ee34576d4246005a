// Several files that belong together, in a folder: all of them are replaced or none, and nothing is lost that
// Millwright has not written itself.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::app {

struct OutputFile {
    std::string name;
    std::string bytes;
};

/// False for what is missing or cannot be read.
[[nodiscard]] bool has_bytes(const std::filesystem::path& file, const std::string& bytes);

/// A folder for results that are still being made: it is made at once, so that one that cannot be is reported
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

/// Files that a command writes into a folder and that belong together.
struct OutputSet {
    std::vector<OutputFile> files;
    std::vector<std::string>
        absent{}; ///< names that would be taken for its own, and are not written this time
    /// A folder has one set of each kind; empty: the set is of none.
    std::string kind{};
};

/// Of sets that are about one program.
inline constexpr std::string_view program_kind = "program";

/// Throws Error if writing files `names` of a set of `kind` into `folder` would replace or remove one of
/// `inputs`. For before the work; those that are missing do not count.
void expect_inputs_kept(const std::filesystem::path& folder,
                        const std::vector<std::string>& names,
                        std::string_view kind,
                        const std::vector<std::filesystem::path>& inputs);

/// Writes all beside their places first and exchanges them then, while no other program of ours does so in
/// this folder. A file there that is not as a command wrote it last gets another name, and that is said on
/// standard error. Where a file of another set is replaced by other bytes or is to be absent, the rest of
/// that set is taken away, which is said, too, and so is all of an older set of the same kind that shares no
/// file with the new one: a folder never has the program of one command and the report of another. Throws
/// Error, also where one of them would replace `source`, a file that they were made from, or one that the
/// user may not write; what was there before then stays.
void write_outputs(const std::filesystem::path& folder,
                   const OutputSet& set,
                   const std::filesystem::path& source = {});

} // namespace millwright::app
