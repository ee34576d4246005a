#include "core/simulation/engagement.h"

#include <fmt/format.h>

#include <iterator>

namespace millwright::simulation {

std::vector<FeedEngagement> engagements(const program::Program& program, const Simulation& found) {
    std::vector<FeedEngagement> feeds;
    for (int n = found.first_block; n < program.block_count(); ++n) {
        const program::Block& block = program.blocks[static_cast<std::size_t>(n)];
        if (block.kind != program::BlockKind::feed) {
            continue;
        }
        FeedEngagement feed{.block = n, .line = block.source_line, .time = block.duration};
        if (const auto cut = found.cuts.find(n); cut != found.cuts.end()) {
            feed.removed = cut->second.volume;
            feed.depth = cut->second.engaged.depth();
            feed.width = cut->second.engaged.width();
        }
        feeds.push_back(feed);
    }
    return feeds;
}

EngagementSummary summary_of(std::span<const FeedEngagement> feeds) {
    EngagementSummary summary;
    const auto take = [](std::optional<FeedEngagement>& most, const FeedEngagement& feed, auto figure) {
        if (!most || figure(feed) > figure(*most)) {
            most = feed;
        }
    };
    for (const FeedEngagement& feed : feeds) {
        ++summary.feeds;
        summary.feed_time += feed.time;
        if (feed.in_air()) {
            ++summary.air_feeds;
            summary.air_time += feed.time;
            continue;
        }
        take(summary.fastest, feed, [](const FeedEngagement& of) { return of.rate(); });
        take(summary.deepest, feed, [](const FeedEngagement& of) { return of.depth; });
        take(summary.widest, feed, [](const FeedEngagement& of) { return of.width; });
    }
    return summary;
}

std::string csv_of(std::span<const FeedEngagement> feeds) {
    std::string text = "line,block,time_s,removed_mm3,rate_mm3_per_min,depth_mm,width_mm,air\n";
    for (const FeedEngagement& feed : feeds) {
        fmt::format_to(std::back_inserter(text),
                       "{},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{}\n",
                       feed.line,
                       feed.block,
                       feed.time,
                       feed.removed,
                       feed.rate(),
                       feed.depth,
                       feed.width,
                       feed.in_air() ? 1 : 0);
    }
    return text;
}

} // namespace millwright::simulation
