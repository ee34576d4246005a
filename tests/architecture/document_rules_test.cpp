#include "tests/architecture/document_rules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>

namespace millwright::architecture {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// The files that exist in the made-up repositories below.
bool made_up(const std::string& path) {
    static const std::set<std::string> paths = {"README.md",
                                                "docs/dev/style.md",
                                                "docs/dev/testing.md",
                                                "core/grid",
                                                "core/grid/grid.h",
                                                "scripts/run"};
    return paths.contains(path);
}

TEST(Links, AreTakenFromTheFolderOfTheirPage) {
    EXPECT_THAT(
        check_links({{"docs/dev/style.md", "see [tests](testing.md) and [start](../../README.md)"}}, made_up),
        IsEmpty());
    EXPECT_THAT(check_links({{"README.md", "\nsee [tests](testing.md)"}}, made_up),
                ElementsAre(Finding{"README.md", 2, "link to nothing: testing.md"}));
}

TEST(Links, OfPicturesCount) {
    EXPECT_THAT(check_links({{"README.md", "![window](docs/window.png)"}}, made_up), SizeIs(1));
}

TEST(Links, ToTheWebAndInCodeAreLeftAlone) {
    EXPECT_THAT(
        check_links({{"README.md", "[a](https://example.org/x) `[b](c)`\n```\n[d](e)\n```\n"}}, made_up),
        IsEmpty());
}

TEST(Links, ToAHeadingNeedTheHeading) {
    const TextFile style = {"docs/dev/style.md", "# House style\n\n## 1. One road, one *direction*\n"};
    EXPECT_THAT(
        check_links({style, {"README.md", "[a](docs/dev/style.md#1-one-road-one-direction)"}}, made_up),
        IsEmpty());
    EXPECT_THAT(check_links({style, {"README.md", "[a](docs/dev/style.md#two-roads)"}}, made_up),
                ElementsAre(Finding{"README.md", 1, "no such heading: docs/dev/style.md#two-roads"}));
}

TEST(Links, WithinAPageNeedTheHeading) {
    EXPECT_THAT(check_links({{"README.md", "# Start\n[a](#start)"}}, made_up), IsEmpty());
    EXPECT_THAT(check_links({{"README.md", "# Start\n[a](#end)"}}, made_up), SizeIs(1));
}

TEST(Paths, NamedInCodeSpansAreThere) {
    EXPECT_THAT(
        check_paths({{"README.md", "`core/grid/grid.h`, `core/grid/`, `scripts/run --out out`"}}, made_up),
        IsEmpty());
    EXPECT_THAT(check_paths({{"README.md", "`core/grid/adapt.h`"}}, made_up),
                ElementsAre(Finding{"README.md", 1, "names what is not there: core/grid/adapt.h"}));
}

TEST(Paths, InShellBlocksAreThere) {
    EXPECT_THAT(check_paths({{"README.md", "```sh\nscripts/run\n```\n"}}, made_up), IsEmpty());
    EXPECT_THAT(check_paths({{"README.md", "```sh\nscripts/start\n```\n"}}, made_up),
                ElementsAre(Finding{"README.md", 2, "names what is not there: scripts/start"}));
}

TEST(Paths, WithAStandInAreNotJudged) {
    EXPECT_THAT(
        check_paths({{"README.md", "`core/*/`, `tests/core/NAME`, `core/<room>/x.h` build/release/x"}},
                    made_up),
        IsEmpty());
}

TEST(Paths, OfPagesInCommentsAreThere) {
    EXPECT_THAT(check_paths({{"core/grid/a.h", "// see docs/dev/style.md#frames, and docs/dev/testing.md."}},
                            made_up),
                IsEmpty());
    EXPECT_THAT(
        check_paths({{"core/grid/a.h", "int a; // corrected in docs/reference/grid.md#forward"}}, made_up),
        ElementsAre(Finding{"core/grid/a.h", 1, "names what is not there: docs/reference/grid.md"}));
}

TEST(Tests, NamedInATableAreThere) {
    const TextFile source{"tests/a_test.cpp", "TEST(Arc, Ends) {\nTEST_F(Line, Begins) {\n"};
    EXPECT_THAT(check_tests({source, {"a.md", "| x | `Arc.Ends`, `Line.*`, `Line.Begins` |\n`No.Table`\n"}}),
                IsEmpty());
    EXPECT_THAT(check_tests({source, {"a.md", "| x | `Arc.Starts`, `Circle.*` |\n"}}),
                ElementsAre(Finding{"a.md", 1, "names a test that is not there: Arc.Starts"},
                            Finding{"a.md", 1, "names a test that is not there: Circle.*"}));
}

TEST(Items, OfATableAreNamedAboveTests) {
    const TextFile source{"tests/a_test.cpp", "// T1, T3: both.\nTEST(Arc, Ends) {\n    go(\"T2\"); // T4\n"};
    const TextFile page{"a.md", "| T1 arcs | x |\n| T3 ends | x |\n| T2 lines | x |\n| T4 points | x |\n"};
    EXPECT_THAT(
        check_items({source, page}, "a.md"),
        ElementsAre(Finding{"a.md", 3, "no test names it: T2"}, Finding{"a.md", 4, "no test names it: T4"}));
    EXPECT_THAT(check_items({source, page}, "b.md"), IsEmpty());
}

class TheseDocuments : public ::testing::Test {
protected:
    const std::vector<TextFile> files_ = read_repository(".");
    const Exists exists_ = [](const std::string& path) { return std::filesystem::exists(path); };
};

TEST_F(TheseDocuments, NameTestsThatAreThere) {
    EXPECT_THAT(check_tests(files_), IsEmpty());
}

TEST_F(TheseDocuments, NameEveryItemOfTheGridAboveATest) {
    EXPECT_THAT(check_items(files_, "docs/dev/grid-tests.md"), IsEmpty());
}

TEST_F(TheseDocuments, LinkToWhatIsThere) {
    EXPECT_THAT(check_links(files_, exists_), IsEmpty());
}

} // namespace
} // namespace millwright::architecture
