#include "ui/simulation_panels/simulation_notices.h"

#include <gtest/gtest.h>

namespace millwright::panels {
namespace {

TEST(SimulationNotices, OnlyWhatWasCheckedIsGood) {
    plan::StockResult result;
    EXPECT_EQ(collision_notice(result).severity, widgets::Severity::good);
    EXPECT_EQ(collision_notice(result).text, "No collisions.");
    result.unchecked = {"the tool has no holder: only its cutter and shank are checked"};
    EXPECT_EQ(collision_notice(result).severity, widgets::Severity::info);
    EXPECT_EQ(collision_notice(result).text,
              "No collisions found. Not checked: the tool has no holder: only its cutter and shank are "
              "checked.");
    result.events.push_back({.kind = plan::StockEventKind::near_miss, .bodies = "cutter and stock"});
    result.events.push_back({.kind = plan::StockEventKind::collision, .bodies = "cutter and stock"});
    EXPECT_EQ(collision_notice(result).severity, widgets::Severity::danger);
    EXPECT_EQ(collision_notice(result).text.find("1 collision or fault. 1 near miss. Not checked: "), 0U);
}

TEST(SimulationNotices, ASentenceBeginsWithItsLine) {
    EXPECT_EQ(sentence_of({{{}, 5, 0, -1}, "not simulated: 2 feeds", "position all axes first"}),
              "Line 5: Not simulated: 2 feeds. Position all axes first.");
    EXPECT_EQ(sentence_of({{}, "no move meets the stock", {}}), "No move meets the stock.");
}

} // namespace
} // namespace millwright::panels
