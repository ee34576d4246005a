// Work that the ranks of one mpirun share: what they tell is gathered at rank 0. On each rank the work runs
// in a thread of its own, and the caller's thread speaks with the others meanwhile, as MPI wants it.
#pragma once

#include "app/studies/ranks.h"
#include "core/base/progress.h"

#include <cstddef>
#include <functional>
#include <stop_token>
#include <string>
#include <string_view>

namespace millwright::app {

using Tell = std::function<void(const std::string& bytes)>;

/// All but `own` by the caller's thread.
struct GatheredWork {
    std::function<void(const Tell&, const std::stop_token&)> own;  ///< of rank 0, in a thread
    std::function<void(int from, const std::string& bytes)> heard; ///< each message, those of rank 0 too
    std::function<bool()> over;                                    ///< asked after each look
    std::function<void()> given_up; ///< no rank answers any more; rank 0 may still be at its own work
};

/// What is shared, for people: "60 cases on 8 ranks"; "60 cases" where there is one rank.
[[nodiscard]] std::string shared_work(std::size_t count, std::string_view thing, const Ranks& ranks);

/// At rank 0: does its own work and hears of it and of the others'. False: the user, or mpirun for a rank
/// that is gone, said stop before it was over; then the others are let go, and who answers is waited for, but
/// not for long: mpirun kills.
[[nodiscard]] bool mpi_gather(const Ranks& ranks, const GatheredWork& work, const Progress& progress);

struct HelpingWork {
    /// What rank 0 asked for by one message, in a thread. It must not throw.
    std::function<void(const std::string& asked, const Tell&, const std::stop_token&)> own;
    /// The user, or mpirun for a rank that is gone, said stop, and rank 0 says nothing: it is the one that is
    /// gone. By the caller's thread; `own` may be at its work yet.
    std::function<void()> deserted;
};

/// At the others: does what rank 0 asks for, one thing after another, until rank 0 lets them go, also in the
/// middle, or until `stop`.
void mpi_help(const Ranks& ranks, const HelpingWork& work, const std::stop_token& stop);

} // namespace millwright::app
