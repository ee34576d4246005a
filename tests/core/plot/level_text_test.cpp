#include "core/plot/level_text.h"

#include "core/base/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace millwright::plot {
namespace {

TEST(LevelText, ChangesWhatItNames) {
    Level like;
    like.depth = 2.0;
    like.tool = 3;
    EXPECT_EQ(parse_level("4", like), (Level{.pen = 4, .depth = 2.0, .tool = 3}));
    EXPECT_EQ(
        parse_level("2:depth=1.5,passes=3,feed=600,plunge=60,order=3,tool=2", like),
        (Level{
            .pen = 2, .order = 2, .depth = 1.5, .passes = 3, .cutting = 10.0, .plunging = 1.0, .tool = 2}));
    EXPECT_FALSE(parse_level("1:off", like).enabled);
    EXPECT_EQ(parse_level("1:tabs=4", like).tabs.count, 4);
    EXPECT_EQ(parse_level("0", like).pen, 0);
}

TEST(LevelText, QuotesWhatIsWrong) {
    for (const char* text : {"",
                             "1:order=0",
                             "1:order=-1",
                             "x",
                             "1:",
                             "1:depth",
                             "1:depth=",
                             "1:depth=1x",
                             "1:depth=inf",
                             "1:passes=0",
                             "1:passes=1.5",
                             "1:colour=3",
                             "1:depth=1,",
                             "1.5",
                             "99999999999"}) {
        try {
            static_cast<void>(parse_level(text, {}));
            ADD_FAILURE() << text;
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), testing::HasSubstr(std::string("'") + text + "'"));
        }
    }
}

} // namespace
} // namespace millwright::plot
