#include "tests/architecture/layout_rules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace millwright::architecture {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

std::string lines(int count) {
    std::string text;
    for (int i = 0; i < count; ++i) {
        text += "\n";
    }
    return text;
}

TEST(Length, OfASourceIsAtMost600Lines) {
    EXPECT_THAT(check_length({{"core/grid/a.cpp", lines(600)}, {"docs/long.md", lines(601)}}), IsEmpty());
    EXPECT_THAT(
        check_length({{"core/grid/a.cpp", lines(601)}}),
        ElementsAre(Finding{"core/grid/a.cpp", 0, "601 lines, more than 600: more than one subject"}));
    EXPECT_THAT(check_length({{"tests/core/grid/a_test.cpp", lines(601)}}), SizeIs(1));
}

TEST(Names, SayWhatIsInside) {
    EXPECT_THAT(check_names({{"core/grid/grid.h", ""}, {"ui/panels/common_grid.cpp", ""}}), IsEmpty());
    EXPECT_THAT(check_names({{"core/utils/text.h", ""}}),
                ElementsAre(Finding{"core/utils/text.h", 0, "'utils' does not say what is inside"}));
    for (const std::string folder : {"common", "helpers", "manager", "misc"}) {
        EXPECT_THAT(check_names({{"ui/" + folder + "/a.cpp", ""}}), SizeIs(1)) << folder;
    }
    EXPECT_THAT(check_names({{"core/grid/helpers.cpp", ""}}), SizeIs(1));
}

TEST(Lists, HoldEverySourceOfTheirFolder) {
    const TextFile list = {"core/grid/CMakeLists.txt",
                           "millwright_module(grid\n    HEADERS grid.h\n    SOURCES grid.cpp)\n"};
    EXPECT_THAT(check_lists({list, {"core/grid/grid.h", ""}, {"core/grid/grid.cpp", ""}}), IsEmpty());
    EXPECT_THAT(
        check_lists({list, {"core/grid/adapt.cpp", ""}}),
        ElementsAre(Finding{"core/grid/adapt.cpp", 0, "not listed in the CMakeLists.txt of its folder"}));
    EXPECT_THAT(check_lists({list, {"core/grid/adapt.h", ""}}), SizeIs(1));
    EXPECT_THAT(check_lists({{"core/loose.cpp", ""}}), SizeIs(1));
}

TEST(Lists, DoNotTakeACommentForAnEntry) {
    const TextFile list = {"core/grid/CMakeLists.txt", "# adapt.cpp comes later\n"};
    EXPECT_THAT(check_lists({list, {"core/grid/adapt.cpp", ""}}), SizeIs(1));
}

TEST(Lists, NameFilesInDeeperFoldersByTheirPath) {
    const TextFile list = {"core/drivers/CMakeLists.txt", "SOURCES grbl/grbl_driver.cpp"};
    EXPECT_THAT(check_lists({list, {"core/drivers/grbl/grbl_driver.cpp", ""}}), IsEmpty());
    EXPECT_THAT(check_lists({list, {"core/drivers/grbl_driver.cpp", ""}}), SizeIs(1));
}

TEST(Lists, LeaveOutHeadersThatNobodyElseMayInclude) {
    const TextFile list = {"core/grid/CMakeLists.txt", ""};
    EXPECT_THAT(check_lists({list, {"core/grid/internal/stencil.h", ""}}), IsEmpty());
    EXPECT_THAT(check_lists({list, {"core/grid/internal/stencil.cpp", ""}}), SizeIs(1));
    EXPECT_THAT(check_lists({{"tests/CMakeLists.txt", ""}, {"tests/support/oracle.h", ""}}), IsEmpty());
}

TEST(Lists, HoldEveryTest) {
    const TextFile list = {"tests/core/grid/CMakeLists.txt", "millwright_test(grid SOURCES grid_test.cpp)"};
    EXPECT_THAT(check_lists({list, {"tests/core/grid/adapt_test.cpp", ""}}), SizeIs(1));
}

TEST(Lists, AreNeverGlobbed) {
    EXPECT_THAT(check_lists({{"core/grid/CMakeLists.txt", "file(GLOB sources *.cpp)"}}),
                ElementsAre(Finding{"core/grid/CMakeLists.txt", 0, "files are listed, never globbed"}));
}

TEST(TestPrograms, LinkTheRoomTheyTestAlone) {
    const std::string head = "millwright_test(grid SOURCES a_test.cpp LINK millwright::grid";
    EXPECT_THAT(check_test_links({{"tests/core/grid/CMakeLists.txt", head + ")"}}), IsEmpty());
    EXPECT_THAT(check_test_links({{"tests/core/grid/CMakeLists.txt", head + " millwright::toolpath)"}}),
                ElementsAre(Finding{"tests/core/grid/CMakeLists.txt",
                                    0,
                                    "links millwright::toolpath, but tests millwright::grid alone"}));
}

class ThisRepository : public ::testing::Test {
protected:
    const std::vector<TextFile> files_ = read_repository(".");
};

TEST_F(ThisRepository, HasNoLongFile) {
    EXPECT_THAT(check_length(files_), IsEmpty());
}
TEST_F(ThisRepository, HasNoEmptyName) {
    EXPECT_THAT(check_names(files_), IsEmpty());
}
TEST_F(ThisRepository, LinksEachTestProgramToOneRoom) {
    EXPECT_THAT(check_test_links(files_), IsEmpty());
}

} // namespace
} // namespace millwright::architecture
