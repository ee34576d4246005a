// Tables and listings that are wider than their box.
#include "tests/ui/stage/stage.h"
#include "ui/widgets/listing.h"
#include "ui/widgets/table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace millwright::widgets {
namespace {

using test::Stage;

/// Differs in rows `from` to `to` of the picture.
bool differs(const test::Picture& a, const test::Picture& b, float from, float to) {
    const auto begin = static_cast<std::size_t>(from) * static_cast<std::size_t>(a.width);
    const auto end = static_cast<std::size_t>(to) * static_cast<std::size_t>(a.width);
    return !std::equal(a.pixels.begin() + static_cast<std::ptrdiff_t>(begin),
                       a.pixels.begin() + static_cast<std::ptrdiff_t>(end),
                       b.pixels.begin() + static_cast<std::ptrdiff_t>(begin));
}

class WideTable : public testing::Test {
protected:
    float width = 400.0F;
    std::string name = "Track optimiser";
    Stage stage{[this](Ui& ui) {
                    const auto pane = ui.pane("compare", {0.0F, 0.0F, width, 300.0F});
                    constexpr Column number{"mean/length", "mm", 1.0F, true};
                    constexpr std::array columns{
                        Column{"Grid", "", 0.5F}, number, number, number, number, number, number};
                    (void)table(ui,
                                "grids",
                                {.columns = columns,
                                 .rows = 3,
                                 .cell =
                                     [this](std::ptrdiff_t row, int column) {
                                         return column == 0 ? name
                                                            : std::to_string(row + column) + "123.4567";
                                     },
                                 .row_id = [](std::ptrdiff_t row) { return std::to_string(row); }});
                },
                {1500.0F, 600.0F}};

    [[nodiscard]] bool has_bar() { return stage.ui().place("compare/grids/sideways").has_value(); }
};

TEST_F(WideTable, CutsNoHeaderAndNoNumberButScrolls) {
    stage.frames(3);
    EXPECT_TRUE(stage.ui().cut_texts().empty());
    ASSERT_TRUE(has_bar());
    const Rect box = stage.place("compare/grids");
    EXPECT_LE(stage.place("compare/grids/sideways").bottom(), box.bottom());
    EXPECT_LE(stage.place("compare/grids/2").bottom(), stage.place("compare/grids/sideways").y)
        << "the bar lies below the rows";
    const test::Picture before = stage.picture();
    const Rect bar = stage.place("compare/grids/sideways");
    stage.drag({bar.x + 5.0F, bar.centre().y}, {bar.right(), bar.centre().y});
    stage.move({box.right() + 50.0F, 500.0F});
    stage.frames(2);
    const test::Picture after = stage.picture();
    EXPECT_TRUE(differs(before, after, box.y, box.y + 20.0F)) << "the header goes along";
    EXPECT_TRUE(
        differs(before, after, stage.place("compare/grids/0").y, stage.place("compare/grids/0").bottom()));
}

TEST_F(WideTable, ScrollsByTheWheelWithShift) {
    stage.frames(3);
    const Rect row = stage.place("compare/grids/0");
    stage.move(row.centre());
    stage.frames(2);
    const test::Picture before = stage.picture();
    stage.hold_shift(true);
    stage.wheel(-2.0F);
    stage.hold_shift(false);
    stage.frames(2);
    EXPECT_TRUE(differs(before, stage.picture(), row.y, row.bottom()));
    EXPECT_EQ(stage.place("compare/grids/0"), row) << "and not down";
}

TEST_F(WideTable, TakesTheRoomThatOtherColumnsCanSpare) {
    width = 790.0F;
    name = "A name that is longer than its share of the table";
    stage.frames(3);
    EXPECT_TRUE(has_bar());
    width = 1400.0F;
    stage.frames(3);
    EXPECT_FALSE(has_bar());
    EXPECT_TRUE(stage.ui().cut_texts().empty());
}

TEST_F(WideTable, EndsALineOfTextThatWouldHaveTheNumbersOutOfSight) {
    name = std::string(300, 'x');
    stage.frames(3);
    ASSERT_EQ(stage.ui().cut_texts().size(), 3U); // its tip is the whole of it
    EXPECT_TRUE(has_bar());
}

class WideListing : public testing::Test {
protected:
    std::vector<std::string> lines{"G1 X1", "G1 X2", "G1 X3"};
    std::string found;
    std::ptrdiff_t wanted = -1;
    Stage stage{[this](Ui& ui) {
        const auto pane = ui.bare_pane("program", {0.0F, 0.0F, 300.0F, 200.0F});
        (void)listing(ui,
                      "lines",
                      {.lines = std::ssize(lines),
                       .line = [this](std::ptrdiff_t n) { return lines[static_cast<std::size_t>(n)]; },
                       .found = found,
                       .wanted = wanted});
    }};

    [[nodiscard]] bool has_bar() { return stage.ui().place("program/lines/sideways").has_value(); }
    void take_away_mouse() {
        stage.move({700.0F, 500.0F});
        stage.frames(2);
    }
};

TEST_F(WideListing, ScrollsToTheEndOfALongLine) {
    stage.frames(3);
    EXPECT_FALSE(has_bar());
    lines[1] = "(" + std::string(120, 'a') + " end)";
    stage.frames(3);
    ASSERT_TRUE(has_bar());
    take_away_mouse();
    const test::Picture before = stage.picture();
    const Rect bar = stage.place("program/lines/sideways");
    stage.drag({bar.x + 5.0F, bar.centre().y}, {bar.right() + 100.0F, bar.centre().y});
    take_away_mouse();
    EXPECT_TRUE(differs(before, stage.picture(), 0.0F, 60.0F));
    lines = {"M2"};
    stage.frames(3);
    EXPECT_FALSE(has_bar());
}

TEST_F(WideListing, ShowsWhatWasLookedForAtTheEndOfALongLine) {
    lines[2] = std::string(150, 'a') + " needle";
    stage.frames(3);
    take_away_mouse();
    const test::Picture before = stage.picture();
    found = "needle";
    stage.frames(3);
    wanted = 2;
    stage.frames(3);
    EXPECT_TRUE(differs(before, stage.picture(), 0.0F, 60.0F));
    wanted = -1;
    found = "G1";
    stage.frames(3);
    wanted = 0;
    stage.frames(3);
    found.clear();
    stage.frames(3);
    const test::Picture again = stage.picture();
    EXPECT_FALSE(differs(before, again, 0.0F, 20.0F)) << "back at the beginning of the line";
}

} // namespace
} // namespace millwright::widgets
