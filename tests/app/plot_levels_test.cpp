// Levels of a plot on the command line: what each pen is cut with, and where.
#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace millwright::test {
namespace {

using testing::HasSubstr;

// A plate with a hole of another pen: the hole was cut on its outside, too, and came out too large.
TEST(PlotCommand, EachPenHasItsSideItsCutterAndItsTool) {
    const ScratchFolder folder;
    const std::string plate = (folder / "plate.plt").string();
    const std::string file = (folder / "plate.ngc").string();
    write_content(plate,
                  "IN;SP1;PU400,400;PD4400,400,4400,4400,400,4400,400,400;PU;"
                  "SP2;PU1400,1400;PD3400,1400,3400,3400,1400,3400,1400,1400;PU;SP;");
    const auto cut = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words{"plot",
                                       "toolpath",
                                       plate,
                                       "--side",
                                       "outside",
                                       "--tool-diameter",
                                       "3",
                                       "--origin",
                                       "20,20",
                                       "--out",
                                       file};
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    };
    const Ended inside = cut({"--level", "2:side=inside"});
    ASSERT_EQ(inside.exit_code, 0) << inside.err;
    std::string text = content_of(file);
    for (const char* word : {"X28.5000", "X131.5000", "X56.5000", "X103.5000"}) {
        EXPECT_THAT(text, HasSubstr(word)); // 1.5 mm outside of the plate, and inside of the hole
    }
    const Ended wider = cut({"--level", "2:side=inside,cutter=6,tool=2", "--change-position", "5,6,40"});
    ASSERT_EQ(wider.exit_code, 0) << wider.err;
    text = content_of(file);
    for (const char* word :
         {"X28.5000", "X58.0000", "X102.0000", "X5.0000", "Y6.0000", "Z40.0000", "to tool 2"}) {
        EXPECT_THAT(text, HasSubstr(word));
    }
    EXPECT_THAT(text, HasSubstr("(T1 D=3. CR=0. - FLAT END MILL)\n(T2 D=6. CR=0. - FLAT END MILL)\n"));
    const Ended low = cut({"--level", "2:side=inside,tool=2", "--change-position", "5,6,4"});
    EXPECT_EQ(low.exit_code, 1); // it was raised to the safe height without a word
    EXPECT_THAT(
        low.err,
        HasSubstr("--change-position: the tool change position at Z 4 mm is below the safe height of 5 mm"));
    EXPECT_THAT(cut({"--level", "2:cutter=6"}).err,
                HasSubstr("tool 1 is 6 mm wide in one level, but 3 mm in another"));
    EXPECT_THAT(cut({"--level", "2:order=8,side=inside", "--level", "2:order=9"}).err,
                HasSubstr("two levels of pen 2 differ in side or cutter"));
    EXPECT_THAT(cut({"--level", "2:side=left"}).err, HasSubstr("'left' is not a cutter side"));
}

TEST(PlotCommand, LevelsThatContradictEachOtherAreRefused) {
    const ScratchFolder folder;
    write_content(folder / "line.plt", "IN;SP1;PU200,200;PD4200,200;PU;SP;");
    const std::string file = (folder / "line.ngc").string();
    const auto cut = [&](std::vector<std::string> levels) {
        std::vector<std::string> words{"plot", "toolpath", (folder / "line.plt").string(), "--out", file};
        for (const std::string& level : levels) {
            words.insert(words.end(), {"--level", level});
        }
        return run(words);
    };
    const Ended twice = cut({"1:depth=1", "1:depth=2"});
    EXPECT_EQ(twice.exit_code, 1);
    EXPECT_THAT(twice.err,
                HasSubstr("level '1:depth=2': pen 1 already has one with the same tool and order"));
    EXPECT_THAT(cut({"1:depth=1,feed=90,depth=2"}).err, HasSubstr("'depth' is given twice"));
    EXPECT_FALSE(std::filesystem::exists(file));
    const Ended both = cut({"1:depth=1,order=1", "1:depth=2,order=2"});
    EXPECT_EQ(both.exit_code, 0) << both.err;
    EXPECT_THAT(content_of(file), HasSubstr("Z-1.0000"));
    EXPECT_THAT(content_of(file), HasSubstr("Z-2.0000"));
}

} // namespace
} // namespace millwright::test
