// The cases of a study on all ranks: case n on rank n % size. The rows are those of one process, to the bit.
#pragma once

#include "app/studies/ranks.h"
#include "core/base/progress.h"
#include "core/studies/kinematic_study.h"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace millwright::app {

struct SpreadStudy {
    std::vector<std::vector<studies::StudyRow>> rows; ///< one element a case; empty for one that did not come
    std::vector<std::string>
        lost;             ///< a sentence a rank that failed or went, with its cases that did not come
    bool stopped = false; ///< because the user, or mpirun, said so
};

/// One case on this rank. Throws as it likes.
using StudyOne = std::function<std::vector<studies::StudyRow>(const studies::StudyCase&, const Progress&)>;

/// What is reported on the way, by the caller's thread.
struct StudyNews {
    /// The rows of all cases that have come, as in SpreadStudy::rows, whenever another one has.
    std::function<void(const std::vector<std::vector<studies::StudyRow>>&)> came;
    /// The rows of each case in the order of the cases, as soon as those before it have come.
    std::function<void(std::span<const studies::StudyRow>)> done;
    /// Each sentence of SpreadStudy::lost, once: as soon as it is known, since mpirun may leave no time
    /// after.
    std::function<void(const std::string&)> lost;
};

/// At rank 0: does its own cases in a thread and gathers those of the others.
[[nodiscard]] SpreadStudy gather_study(const Ranks& ranks,
                                       std::span<const studies::StudyCase> cases,
                                       const StudyOne& study,
                                       const StudyNews& news,
                                       const Progress& progress);

/// At the others: does their cases and reports to rank 0. Never throws what `study` throws: that is reported
/// to rank 0. Where rank 0 is gone `deserted` is called with a sentence, by the caller's thread, that says
/// which cases of this rank are lost; with an empty one if they are all done.
void help_with_study(const Ranks& ranks,
                     std::span<const studies::StudyCase> cases,
                     const StudyOne& study,
                     const std::function<void(const std::string& lost)>& deserted,
                     const std::stop_token& stop);

} // namespace millwright::app
