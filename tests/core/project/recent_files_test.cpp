#include "core/project/recent_files.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace millwright::project {
namespace {

using testing::ElementsAre;

TEST(RecentFiles, TheLastOpenedComesFirstAndOnce) {
    RecentFiles files = with_recent({}, "/a.json");
    files = with_recent(files, "/b.json");
    files = with_recent(files, "/x/../a.json");
    EXPECT_THAT(files, ElementsAre("/a.json", "/b.json"));
}

TEST(RecentFiles, TenAreKept) {
    RecentFiles files;
    for (int n = 0; n < 30; ++n) {
        files = with_recent(files, "/" + std::to_string(n));
    }
    EXPECT_EQ(files.size(), most_recent_files);
    EXPECT_EQ(files.back(), "/20");
}

TEST(RecentFiles, SurviveTheirFile) {
    const test::ScratchFolder scratch;
    const auto place = scratch / "new/folder/recent.json";
    EXPECT_TRUE(read_recent(place).empty());
    const RecentFiles files{"/with \"quotes\".json", "/b.json"};
    write_recent(files, place);
    EXPECT_EQ(read_recent(place), files);
}

TEST(RecentFiles, ABrokenFileIsNamed) {
    const test::ScratchFolder scratch;
    write_file(scratch / "recent.json", "[\"/a\", 3]");
    try {
        (void)read_recent(scratch / "recent.json");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.diagnostic().place.file, scratch / "recent.json");
        EXPECT_EQ(error.diagnostic().place.line, 1);
    }
}

} // namespace
} // namespace millwright::project
