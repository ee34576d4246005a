#include "app/studies/unfinished_study.h"

#include "app/studies/study_pictures.h"
#include "core/base/counted.h"
#include "core/base/error.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <iterator>
#include <system_error>
#include <utility>

namespace millwright::app {

namespace fs = std::filesystem;

namespace {

using studies::StudyCase;
using studies::StudyRow;

constexpr const char* missing_name = "missing.txt";

std::string missing_text(std::span<const StudyCase> cases, const std::vector<std::vector<StudyRow>>& rows) {
    std::string names;
    std::size_t missing = 0;
    for (std::size_t n = 0; n < cases.size(); ++n) {
        if (rows[n].empty()) {
            names += name_of(cases[n]) + "\n";
            ++missing;
        }
    }
    return fmt::format("not in these tables: {} of {} cases\n{}", missing, cases.size(), names);
}

std::optional<fs::file_time_type> written_at(const fs::path& file) {
    std::error_code none;
    const fs::file_time_type time = fs::last_write_time(file, none);
    return none ? std::nullopt : std::optional(time);
}

} // namespace

std::string name_of(const StudyCase& of) {
    return fmt::format("{} on {} with {}", of.surface, of.machine, counted(of.points, "point"));
}

std::vector<StudyRow> joined(const std::vector<std::vector<StudyRow>>& rows) {
    std::vector<StudyRow> all;
    for (const std::vector<StudyRow>& of_case : rows) {
        all.insert(all.end(), of_case.begin(), of_case.end());
    }
    return all;
}

std::vector<OutputFile> study_tables(const std::vector<StudyRow>& rows) {
    return {{"kinematic-error.csv", studies::study_csv(rows)},
            {"kinematic-error.json", studies::study_json(rows)},
            {"kinematic-error.md", studies::study_markdown(rows)}};
}

UnfinishedStudy::UnfinishedStudy(const fs::path& out)
    : folder_(out / "unfinished"), earlier_(written_at(folder_ / missing_name)) {}

std::optional<fs::path> UnfinishedStudy::set_earlier_aside() const {
    if (!earlier_ || kept()) {
        return std::nullopt;
    }
    fs::path aside;
    for (int n = 1; aside.empty() || fs::exists(aside); ++n) {
        aside = folder_.parent_path() / fmt::format("unfinished-{}", n);
    }
    std::error_code failure;
    fs::rename(folder_, aside, failure);
    if (failure) {
        throw Error(
            fmt::format("cannot set aside the earlier study in {}: {}", folder_.string(), failure.message()));
    }
    return aside;
}

std::optional<fs::path> UnfinishedStudy::keep(std::span<const StudyCase> cases,
                                              const std::vector<std::vector<StudyRow>>& rows,
                                              std::vector<OutputFile> pictures) {
    std::optional<fs::path> aside = set_earlier_aside();
    std::vector<OutputFile> files = study_tables(joined(rows));
    files.push_back({missing_name, missing_text(cases, rows)});
    tables_ = files;
    std::ranges::move(pictures, std::back_inserter(files));
    write_outputs(folder_, {files});
    return aside;
}

bool UnfinishedStudy::kept() const {
    const auto now = written_at(folder_ / missing_name);
    return now && now != earlier_;
}

void UnfinishedStudy::remove(std::span<const StudyCase> cases) const {
    const bool ours = std::ranges::all_of(
        tables_, [this](const OutputFile& table) { return has_bytes(folder_ / table.name, table.bytes); });
    if (!kept() || !ours) {
        return;
    }
    std::error_code ignored;
    for (const OutputFile& table : study_tables({})) {
        fs::remove(folder_ / table.name, ignored);
    }
    fs::remove(folder_ / missing_name, ignored);
    for (const StudyCase& of : cases) {
        fs::remove(folder_ / study_picture_name(of), ignored);
    }
    ::rmdir(folder_.c_str()); // nothing but an empty folder
}

} // namespace millwright::app
