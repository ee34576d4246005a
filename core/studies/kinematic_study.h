// The comparison that everything here is for: the same surfaces on the same machines with the same number of
// nodes, the grid made by one method after another, side by side.
#pragma once

#include "core/plan/plan.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace millwright::studies {

enum class StudyMethod {
    uniform,        ///< equal parameter steps
    redistribution, ///< equal shares of a monitor of the error on each track
    elliptic,       ///< the thesis's adaptation
    harmonic,       ///< the harmonic map with sliding boundary
    tracks,         ///< the track optimiser: shortest path per track
    chain,          ///< the whole chain
    sequencing,     ///< the same grid, branches and turns chosen for the least error of the whole path
    set_up,         ///< equal parameter steps, the part where the error is least
    set_up_chain,   ///< the whole chain there
    everything,     ///< and branches and turns chosen as above
};
inline constexpr std::array every_study_method{StudyMethod::uniform,
                                               StudyMethod::redistribution,
                                               StudyMethod::elliptic,
                                               StudyMethod::harmonic,
                                               StudyMethod::tracks,
                                               StudyMethod::chain,
                                               StudyMethod::sequencing,
                                               StudyMethod::set_up,
                                               StudyMethod::set_up_chain,
                                               StudyMethod::everything};
/// For people, and in the files.
[[nodiscard]] std::string_view label(StudyMethod method);

/// One surface on one machine.
struct StudyCase {
    std::string surface; ///< id of a preset
    std::string machine; ///< id of a shipped machine
    int points = 0;      ///< nodes per track
    int tracks = 0;
};

/// dome, sine, two-bell and saddle, each on a table-table, a table-head and a head-head machine: with 15, 20,
/// 30, 40 and 60 points on 20 tracks, or quickly with 12 on 8.
[[nodiscard]] std::vector<StudyCase> full_study();
[[nodiscard]] std::vector<StudyCase> quick_study();

struct StudyFigures {
    grid::ErrorSummary error; ///< distance of the true tip from the surface, over the moves inside tracks
    double track_gap = 0.0;   ///< mm
    double path_length = 0.0; ///< mm
    std::optional<double> time = {}; ///< of a program, s; nothing where the machine runs none
    Vec3 offset = Vec3::Zero();      ///< of the part on the table, mm
};

struct StudyRow {
    StudyCase of;
    StudyMethod method = StudyMethod::uniform;
    std::optional<StudyFigures> figures; ///< nothing where the path cannot be run
    std::string note = {};               ///< why, or what the method says of itself
    bool no_gain = false;  ///< nothing better than what the method starts from was found, which is kept
    std::string loss = {}; ///< "largest +3.1 %": what a set-up costs where it gains elsewhere; empty: nothing
};

/// One row a method, in their order. Only `folders.assets` matters. Throws Error if surface or machine are
/// unknown, Cancelled.
[[nodiscard]] std::vector<StudyRow>
studied(const StudyCase& of, const plan::Folders& folders, const Progress& progress);

/// Comma-separated, one line per row.
[[nodiscard]] std::string study_csv(std::span<const StudyRow> rows);
[[nodiscard]] std::string study_json(std::span<const StudyRow> rows);
/// One table a surface and machine: largest / mean error and the largest axis deviation, and where a method
/// gained nothing.
[[nodiscard]] std::string study_markdown(std::span<const StudyRow> rows);

} // namespace millwright::studies
