// What a study leaves that ends in the middle, however it ends: the cases that are done, in a folder of their
// own, apart from those of a whole study.
#pragma once

#include "app/command_line/output_transaction.h"
#include "core/studies/kinematic_study.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace millwright::app {

/// For people.
[[nodiscard]] std::string name_of(const studies::StudyCase& of);

/// Of all cases, one case after another.
[[nodiscard]] std::vector<studies::StudyRow> joined(const std::vector<std::vector<studies::StudyRow>>& rows);

/// kinematic-error.csv, .json and .md.
[[nodiscard]] std::vector<OutputFile> study_tables(const std::vector<studies::StudyRow>& rows);

/// OUT/unfinished, of one study on any of its ranks.
class UnfinishedStudy {
public:
    /// Made before the first case is done. Changes nothing.
    explicit UnfinishedStudy(const std::filesystem::path& out);

    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

    /// Writes the tables of the cases that have come, and missing.txt, which names the others. `rows` has an
    /// element a case, empty for one that did not come. The first time what an earlier study left goes to a
    /// folder beside it, unfinished-1 ..., which is returned. Throws Error.
    /// `pictures` are written with them.
    std::optional<std::filesystem::path> keep(std::span<const studies::StudyCase> cases,
                                              const std::vector<std::vector<studies::StudyRow>>& rows,
                                              std::vector<OutputFile> pictures = {});
    /// Whether keep() was called, on whatever rank that writes into the same folder.
    [[nodiscard]] bool kept() const;
    /// Takes away what this one kept, with the pictures of these cases, and the folder where nothing else is
    /// in it. What another study has written there meanwhile stays.
    void remove(std::span<const studies::StudyCase> cases) const;

private:
    [[nodiscard]] std::optional<std::filesystem::path> set_earlier_aside() const;

    std::filesystem::path folder_;
    std::optional<std::filesystem::file_time_type> earlier_; ///< when an earlier study wrote there
    std::vector<OutputFile> tables_;                         ///< as this one wrote them last
};

} // namespace millwright::app
