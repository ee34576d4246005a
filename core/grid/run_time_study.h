// How long the thesis's iteration takes: processor and wall time by size of the grid and number of threads,
// and the parts of an iteration. Beside it what the thesis measured on a Convex SPP-1600.
// Source: (Parasilmongkol 1997, KMITL) tables 7-1, 7-2 and appendix A.
#pragma once

#include "core/base/progress.h"

#include <array>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

namespace millwright::grid {

/// s since any moment.
struct StudyClocks {
    std::function<double()> wall;
    std::function<double()> processor; ///< of all threads of this process
    /// Processor time of all programs on all cores of the machine; nothing where it is unknown.
    std::function<std::optional<double>()> machine = [] { return std::nullopt; };
};

struct RunTimeSettings {
    std::vector<int> sides{50, 70, 100, 150, 257}; ///< nodes per side, 3 or more
    std::vector<int> threads{1}; ///< 1 or more; the first is what the others are compared with
    int iterations = 10;
    int repeats = 5;      ///< the fastest run counts
    double warm_up = 0.0; ///< s of runs that are not timed before the first one, beside one run of each case
};

/// The fastest of the repeated runs of all iterations.
struct RunTime {
    int side = 0;
    int threads = 0;
    double processor = 0.0; ///< s
    double wall = 0.0;      ///< s
    double speed_up = 1.0;  ///< wall time of the first number of threads divided by this one
    bool same_nodes = true; ///< to the bit as with the first number of threads
};

/// Wall time in the parts of all iterations, one thread, s.
/// Processor time of one thread, s, of the fastest of the repeats.
struct RunTimeProfile {
    int side = 0;
    double weight = 0.0;    ///< w at every node
    double equations = 0.0; ///< derivatives, coefficients and residuals
    double update = 0.0;    ///< 2 x 2 systems and moving the nodes
    double norm = 0.0;
    double checks = 0.0; ///< for folded cells and numbers that are not finite; the thesis has none

    [[nodiscard]] double sum() const { return weight + equations + update + norm + checks; }
};

struct RunTimeStudy {
    std::vector<RunTime> runs; ///< by side, then by threads
    std::vector<RunTimeProfile> profiles;
    /// Processor time per wall time of all runs with one thread: less than 1 where other programs took its
    /// core. 1 without such runs.
    double one_thread_share = 1.0;
    std::optional<double> other_cores; ///< that other programs used meanwhile, on average
};

/// JacobiNewton on uniform grids with W1 as wide as on 25 x 25 nodes, LV = 1, WW = 0.81, without a tolerance.
/// Puts the number of threads back. Throws Cancelled.
[[nodiscard]] RunTimeStudy
run_time_study(const RunTimeSettings& settings, const StudyClocks& clocks, const Progress& progress);

/// A row of table 7-1, one thread.
struct ThesisRunTime {
    std::string_view weight;
    int side;
    double processor, wall; ///< s
    int iterations;         ///< 19 by the profile; the others estimated from the same cost per node
};
inline constexpr std::array<ThesisRunTime, 5> thesis_table_7_1{{{"W4", 50, 479.352, 1148.793, 18},
                                                                {"W4", 70, 992.345, 1850.075, 19},
                                                                {"W4", 100, 2623.686, 4807.246, 24},
                                                                {"W4", 150, 9983.924, 18614.645, 40},
                                                                {"W3", 100, 12715.816, 43173.387, 117}}};

/// A row of table 7-2: ten iterations; the thesis does not say of how many nodes.
struct ThesisCompilation {
    std::string_view option;
    int threads;
    double processor, wall; ///< s
};
inline constexpr std::array<ThesisCompilation, 4> thesis_table_7_2{{{"-O0", 1, 165.577, 169.532},
                                                                    {"-O1", 1, 165.577, 169.532},
                                                                    {"-O2", 1, 165.882, 168.198},
                                                                    {"-O3", 8, 169.448, 171.057}}};

/// Shares of the processor time of the thesis's profile (70 x 70 nodes, appendix A): its routine W with what
/// it calls, the rest of Nabor, iteration itself, NNorm.
struct ThesisProfile {
    double weight = 58.914 / 992.345;
    double equations = (982.242 - 58.914) / 992.345;
    double update = 4.226 / 992.345;
    double norm = 0.670 / 992.345;
};

} // namespace millwright::grid
