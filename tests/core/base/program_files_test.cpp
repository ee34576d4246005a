#include "core/base/program_files.h"

#include "core/base/files.h"
#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>

namespace millwright {
namespace {

TEST(ProgramFiles, TheExecutableIsThisTest) {
    EXPECT_EQ(executable().filename(), "base_test");
}

TEST(ProgramFiles, AreFoundInAFolderAbove) {
    const test::ScratchFolder scratch;
    make_folder(scratch / "usr/share/millwright");
    EXPECT_EQ(find_above(scratch / "usr/bin/millwright", {"share/millwright"}),
              scratch / "usr/share/millwright");
    EXPECT_EQ(find_above(scratch / "usr/bin/millwright", {"share/no-such-thing"}), std::nullopt);
}

TEST(ProgramFiles, TheNearestIsFound) {
    const test::ScratchFolder scratch;
    make_folder(scratch / "share/millwright");
    make_folder(scratch / "checkout/assets");
    EXPECT_EQ(find_above(scratch / "checkout/build/millwright", {"share/millwright", "assets"}),
              scratch / "checkout/assets");
    EXPECT_EQ(find_above(scratch / "checkout/build/millwright", {"checkout", "share/millwright"}),
              scratch / "checkout");
}

TEST(ProgramFiles, NothingIsFoundForAnUnknownExecutable) {
    EXPECT_EQ(find_above({}, {"usr"}), std::nullopt);
}

} // namespace
} // namespace millwright
