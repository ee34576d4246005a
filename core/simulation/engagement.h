// What each feed of a simulated program cut: removal rate, depth and width, and how much of its time a tool
// is in air. Times are those that the program asks for: acceleration is not part of them.
#pragma once

#include "core/simulation/simulation.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace millwright::simulation {

/// Of a simulated feed.
struct FeedEngagement {
    int block = 0;
    int line = 0;         ///< of the program's file; 0: unknown
    double time = 0.0;    ///< s
    double removed = 0.0; ///< mm^3
    double depth = 0.0;   ///< along the tool axis, mm, to a cell
    double width = 0.0;   ///< across axis and direction, mm, to a cell

    [[nodiscard]] bool in_air() const { return !(removed > 0.0); }
    /// mm^3/min; 0 of a feed that takes no time.
    [[nodiscard]] double rate() const { return time > 0.0 ? 60.0 * removed / time : 0.0; }
};

/// In the order of the blocks.
[[nodiscard]] std::vector<FeedEngagement> engagements(const program::Program& program,
                                                      const Simulation& found);

struct EngagementSummary {
    double feed_time = 0.0; ///< s
    double air_time = 0.0;  ///< of it, s
    int feeds = 0;
    int air_feeds = 0;
    /// The greatest; nullopt if nothing was cut.
    std::optional<FeedEngagement> fastest, deepest, widest;
};
[[nodiscard]] EngagementSummary summary_of(std::span<const FeedEngagement> feeds);

/// One line a feed, after a line of names.
[[nodiscard]] std::string csv_of(std::span<const FeedEngagement> feeds);

} // namespace millwright::simulation
