#include "tests/architecture/repository.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace millwright::architecture {
namespace {

using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::Not;
using ::testing::StartsWith;

TEST(Lines, AreCountedFromOneAndLoseTheirEnds) {
    const auto lines = lines_of("a\n\nb");
    ASSERT_EQ(lines.size(), 3U);
    EXPECT_EQ(lines[0].text, "a");
    EXPECT_EQ(lines[1].text, "");
    EXPECT_EQ(lines[2].text, "b");
    EXPECT_EQ(lines[2].number, 3);
    EXPECT_EQ(lines_of("a\n").size(), 1U);
}

TEST(Words, AreCutAtAnyWhiteSpace) {
    EXPECT_THAT(words_of("  a b\tc\n"), ElementsAre("a", "b", "c"));
}

TEST(Paths, LieInsideAFolderOnlyAsAWholeName) {
    EXPECT_TRUE(is_inside("core/grid/grid.h", "core/grid"));
    EXPECT_TRUE(is_inside("core/grid", "core/grid"));
    EXPECT_FALSE(is_inside("core/gridlock/a.h", "core/grid"));
}

TEST(Repository, IsReadWithoutBuildResults) {
    const auto files = read_repository(".");
    EXPECT_THAT(files, Contains(Field(&TextFile::path, "core/base/error.h")));
    EXPECT_THAT(files, Contains(Field(&TextFile::path, "CMakeLists.txt")));
    EXPECT_THAT(files, Each(Field(&TextFile::path, Not(StartsWith("build/")))));
}

} // namespace
} // namespace millwright::architecture
