#include "ui/widgets/listing.h"

#include "tests/ui/stage/stage.h"
#include "ui/widgets/table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

namespace millwright::widgets {
namespace {

using test::Stage;

class Listing : public testing::Test {
protected:
    std::ptrdiff_t lines = 1'000'000;
    std::ptrdiff_t current = -1;
    std::set<std::ptrdiff_t> asked;
    std::optional<std::ptrdiff_t> clicked;
    Stage stage{[this](Ui& ui) {
        const auto pane = ui.bare_pane("program", {0.0F, 0.0F, 400.0F, 300.0F});
        asked.clear();
        const ListingView view{.lines = lines,
                               .line =
                                   [this](std::ptrdiff_t i) {
                                       asked.insert(i);
                                       return "N" + std::to_string(i) + " G1 X1 (" + std::to_string(i) + ")";
                                   },
                               .current = current};
        if (const auto now = listing(ui, "lines", view)) {
            clicked = now;
        }
    }};

    void SetUp() override { stage.frames(2); }
};

TEST_F(Listing, OfAMillionLinesOnlyThoseInSightAreAskedFor) {
    EXPECT_LE(asked.size(), 20U);
    EXPECT_EQ(*asked.begin(), 0);
}

TEST_F(Listing, TheCurrentLineIsBroughtIntoSight) {
    current = 777'777;
    stage.frames(2);
    EXPECT_TRUE(asked.contains(777'777));
    EXPECT_LE(asked.size(), 20U);
}

TEST_F(Listing, ALineFarDownIsClickedExactly) {
    current = 999'990;
    stage.frames(2);
    const Rect box = stage.place("program/lines");
    const float row = box.h / static_cast<float>(asked.size());
    stage.click_at({box.x + 100.0F, box.y + 2.5F * row});
    ASSERT_TRUE(clicked.has_value());
    EXPECT_NEAR(static_cast<double>(*clicked - *asked.begin()), 2.0, 1.0);
    EXPECT_TRUE(asked.contains(*clicked));
}

TEST_F(Listing, TheWheelScrollsAndTheUserIsNotPulledBack) {
    current = 500;
    stage.frames(2);
    stage.move(stage.place("program/lines").centre());
    stage.frames();
    stage.wheel(-100.0F);
    stage.frames(2);
    EXPECT_GT(*asked.begin(), 600);
}

TEST_F(Listing, TheScrollBarReachesTheLastLine) {
    const Rect bar = stage.place("program/lines/scroll");
    stage.drag({bar.centre().x, bar.y + 3.0F}, {bar.centre().x, bar.bottom() + 100.0F});
    EXPECT_EQ(*asked.rbegin(), lines - 1);
}

TEST_F(Listing, AShorterProgramIsShownFromItsEnd) {
    current = 900'000;
    stage.frames(2);
    lines = 5;
    current = -1;
    stage.frames(2);
    EXPECT_EQ(asked.size(), 5U);
    lines = 0;
    EXPECT_NO_THROW(stage.frames(2));
}

TEST(LongLine, IsToldWholeByItsTip) {
    std::string line = "G1 X1 (short)";
    Stage stage([&](Ui& ui) {
        const auto pane = ui.bare_pane("program", {0.0F, 0.0F, 300.0F, 100.0F});
        (void)listing(ui, "lines", {.lines = 1, .line = [&](std::ptrdiff_t) { return line; }});
    });
    stage.frames(2);
    const auto rests_on_the_line = [&] {
        const Rect box = stage.place("program/lines");
        stage.move({box.x + 100.0F, box.y + 5.0F});
        stage.frames(2);
        stage.wait(1.0);
        stage.frames();
    };
    rests_on_the_line();
    EXPECT_FALSE(stage.ui().place("tip"));
    for (const char* end : {")", "\u00e4\u00b0)"}) {
        line = "G1 X1 (a comment that does not end where the pane does" + std::string(end);
        rests_on_the_line();
        EXPECT_GT(stage.place("tip").w, 300.0F);
    }
}

class Table : public testing::Test {
protected:
    std::ptrdiff_t rows = 100'000;
    std::ptrdiff_t asked = 0;
    std::optional<std::ptrdiff_t> clicked;
    Stage stage{[this](Ui& ui) {
        const auto pane = ui.pane("compare", {0.0F, 0.0F, 400.0F, 400.0F});
        constexpr std::array columns{Column{"Result"}, Column{"Max", "mm", 1.0F, true}};
        asked = 0;
        const TableView view{.columns = columns,
                             .rows = rows,
                             .cell =
                                 [this](std::ptrdiff_t row, int column) {
                                     ++asked;
                                     return column == 0 ? "row " + std::to_string(row) : std::string("1.25");
                                 },
                             .row_id = [](std::ptrdiff_t row) { return "r" + std::to_string(row); },
                             .height = 200.0F};
        if (const auto now = table(ui, "results", view)) {
            clicked = now;
        }
    }};
};

TEST_F(Table, ARowIsFoundByItsIdAndClicked) {
    stage.frames(2);
    stage.click("compare/results/r3");
    EXPECT_EQ(clicked, 3);
}

TEST_F(Table, OnlyTheCellsInSightAreAskedFor) {
    stage.frames(2);
    EXPECT_LE(asked, 2 * 10);
    EXPECT_FALSE(stage.ui().place("compare/results/r50000").has_value());
}

TEST_F(Table, WithoutRowsItSaysSo) {
    rows = 0;
    EXPECT_NO_THROW(stage.frames(2));
    EXPECT_EQ(asked, 0);
}

} // namespace
} // namespace millwright::widgets
