#include "ui/widgets/search.h"

#include "tests/ui/stage/stage.h"
#include "ui/widgets/matching.h"

#include <gtest/gtest.h>

#include <array>

namespace millwright::widgets {
namespace {

using test::Key;
using test::Stage;

TEST(Fuzzy, NeedsEveryLetterInItsOrder) {
    EXPECT_TRUE(fuzzy_score("adgr", "Adapt the grid").has_value());
    EXPECT_TRUE(fuzzy_score("ADAPT", "Adapt the grid").has_value());
    EXPECT_TRUE(fuzzy_score("grid ad", "Grid: adapt").has_value());
    EXPECT_FALSE(fuzzy_score("gda", "Adapt the grid").has_value());
    EXPECT_FALSE(fuzzy_score("adaptt the gridd", "Adapt the grid").has_value());
    EXPECT_FALSE(fuzzy_score("x", "").has_value());
    EXPECT_EQ(fuzzy_score("", "anything"), 0);
}

TEST(Fuzzy, StartsOfWordsAndRunsCountMore) {
    EXPECT_GT(*fuzzy_score("sp", "Save project"), *fuzzy_score("sp", "Display"));
    EXPECT_GT(*fuzzy_score("grid", "Grid: adapt"), *fuzzy_score("grid", "Giro id"));
    EXPECT_GT(*fuzzy_score("save", "Save"),
              *fuzzy_score("save", "Save a copy of the whole project elsewhere"));
}

// "Joint limits" was first, and Enter took it without a word.
TEST(FindItems, ATitleThatBeginsWithTheVeryWordComesFirst) {
    const std::array<SearchItem, 3> layers{SearchItem{"joints", "Joint limits", "Arm"},
                                           SearchItem{"other", "Smooth join", "Design"},
                                           SearchItem{"join", "Join the patches smoothly", "Design"}};
    EXPECT_EQ(find_items("join", layers).front(), 2);
    EXPECT_EQ(find_items("Join ", layers).front(), 2);
    EXPECT_EQ(find_items("joint", layers).front(), 0);
}

TEST(FindItems, WholeWordsComeBeforePartsAndPartsBeforeScatteredLetters) {
    const std::array<SearchItem, 5> all{SearchItem{"a", "Adaptive fitting", "Grid"},
                                        SearchItem{"b", "Outfits", "Grid"},
                                        SearchItem{"c", "Fit the view", "View"},
                                        SearchItem{"d", "Follow it", "View"},
                                        SearchItem{"e", "Zoom", "View", "", {}, "fit, whole view"}};
    EXPECT_EQ(find_items("fit", all), (std::vector<std::ptrdiff_t>{2, 4, 0, 1}));
    EXPECT_EQ(find_items("view fit", all), (std::vector<std::ptrdiff_t>{2, 4}));
    EXPECT_EQ(find_items("flwt", all), (std::vector<std::ptrdiff_t>{3}));
}

// All that was refused stood first when the list was opened.
TEST(FindItems, WhatIsRefusedComesLast) {
    std::array<SearchItem, 3> all{SearchItem{"undo", "Undo", "Edit"},
                                  SearchItem{"keep", "Keep the undo steps", "Edit"},
                                  SearchItem{"redundo", "Redundo", "Edit"}};
    all[0].permission = Permission::refused("Nothing to undo.");
    EXPECT_EQ(find_items("", all), (std::vector<std::ptrdiff_t>{1, 2, 0}));
    EXPECT_EQ(find_items("undo", all), (std::vector<std::ptrdiff_t>{1, 2, 0}));
}

TEST(FindItems, OtherNamesAndWordsOfTheTipFindToo) {
    const std::array<SearchItem, 3> all{
        SearchItem{"fit", "Fit the view", "View", "", {}, "zoom, whole view", "Shows everything."},
        SearchItem{"home", "Home", "Machine", "", {}, "", "Finds the machine's zero by its switches."},
        SearchItem{"theme", "Light theme", "View", "", {}, "dark, night", "Changes the colours."}};
    EXPECT_EQ(find_items("zoom", all), (std::vector<std::ptrdiff_t>{0}));
    EXPECT_EQ(find_items("zero", all), (std::vector<std::ptrdiff_t>{1}));
    EXPECT_EQ(find_items("dark", all), (std::vector<std::ptrdiff_t>{2}));
    EXPECT_TRUE(find_items("zeroes", all).empty());
}

constexpr std::array items{SearchItem{"grid.adapt", "Adapt the grid", "Grid", "Ctrl+G"},
                           SearchItem{"file.save", "Save", "File", "Ctrl+S"},
                           SearchItem{"file.save_as", "Save as ...", "File"}};

class SearchPalette : public testing::Test {
protected:
    Search search;
    std::vector<std::ptrdiff_t> chosen;
    bool running_allowed = false;
    Stage stage{[this](Ui& ui) {
        std::vector<SearchItem> all(items.begin(), items.end());
        all.push_back({"job.run", "Run the program", "Machine", "F9"});
        all.back().permission =
            running_allowed ? Permission{} : Permission::refused("No machine is connected.");
        const auto pane = ui.pane("main", {0.0F, 0.0F, 800.0F, 600.0F});
        ui.button("below", "Below");
        if (const auto index = search.draw(ui, "palette", all)) {
            chosen.push_back(*index);
        }
    }};

    void SetUp() override {
        stage.frames(2);
        search.open();
        stage.frames(3);
    }
};

TEST_F(SearchPalette, AFewLettersAndEnterRunTheBest) {
    stage.type("savas");
    stage.key(Key::enter);
    EXPECT_EQ(chosen, (std::vector<std::ptrdiff_t>{2}));
    EXPECT_FALSE(search.is_open());
}

// On a slow screen a word is typed before the field has the keyboard: Enter took the first of all.
TEST_F(SearchPalette, WhatIsTypedWhileItOpensCounts) {
    for (const int frames : {0, 1, 2}) {
        chosen.clear();
        search.close();
        stage.frames(2);
        search.open();
        if (frames > 0) {
            stage.frames(frames);
            EXPECT_TRUE(stage.ui().is_typing()) << "or the keys would be shortcuts";
        }
        stage.type("sav");
        stage.type("as");
        stage.key(Key::enter);
        EXPECT_EQ(chosen, (std::vector<std::ptrdiff_t>{2})) << frames << " frames after it was opened";
    }
}

TEST_F(SearchPalette, TheArrowKeysChoose) {
    stage.type("save");
    stage.key(Key::down);
    stage.key(Key::enter);
    EXPECT_EQ(chosen, (std::vector<std::ptrdiff_t>{2}));
}

TEST_F(SearchPalette, AClickOnARowRunsIt) {
    stage.click("main/palette/file.save");
    EXPECT_EQ(chosen, (std::vector<std::ptrdiff_t>{1}));
}

TEST_F(SearchPalette, WhatIsNotAllowedIsNotRunAndSaysWhy) {
    stage.type("run");
    stage.key(Key::enter);
    EXPECT_TRUE(chosen.empty());
    EXPECT_EQ(stage.reason("main/palette/job.run"), "No machine is connected.");
    EXPECT_TRUE(search.is_open());
}

// A click on what is refused took the keyboard away: the next letters went to what lies behind.
TEST_F(SearchPalette, KeepsTheKeyboardAfterAClickOnWhatIsRefused) {
    stage.click("main/palette/job.run");
    stage.frames(6);
    stage.type("savas");
    stage.key(Key::enter);
    EXPECT_EQ(chosen, (std::vector<std::ptrdiff_t>{2}));
}

TEST_F(SearchPalette, EscAndAClickElsewhereCloseIt) {
    stage.key(Key::escape);
    EXPECT_FALSE(search.is_open());
    search.open();
    stage.frames(3);
    stage.click_at({10.0F, 590.0F});
    EXPECT_FALSE(search.is_open());
    EXPECT_TRUE(chosen.empty());
}

TEST_F(SearchPalette, OpenedAgainItStartsEmpty) {
    stage.type("save");
    stage.key(Key::escape);
    search.open();
    stage.frames(3);
    EXPECT_TRUE(stage.ui().place("main/palette/grid.adapt").has_value());
    stage.type("qqq");
    EXPECT_FALSE(stage.ui().place("main/palette/grid.adapt").has_value());
}

} // namespace
} // namespace millwright::widgets
