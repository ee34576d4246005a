#include "ui/widgets/matching.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

namespace millwright::widgets {
namespace {

const std::vector<std::string> history{"#1J+", "I122=0.2", "I130=5000", "#1J/"};
constexpr std::array<std::string_view, 4> pmac_words{"DISABLE PLC", "CLEAR", "CLOSE", "LIST PROG"};

TEST(Completion, GrowsAsFarAsAllLinesAgree) {
    EXPECT_EQ(completed("I", history, pmac_words), "I1");
    EXPECT_EQ(completed("I12", history, pmac_words), "I122=0.2");
}

TEST(Completion, TakesTheNewestLineWhereTheyPart) {
    EXPECT_EQ(completed("I1", history, pmac_words), "I130=5000");
    EXPECT_EQ(completed("#1J", history, pmac_words), "#1J/");
}

TEST(Completion, CompletesTheLastWordWhereNoLineBeginsSo) {
    EXPECT_EQ(completed("c", history, pmac_words), "CL");
    EXPECT_EQ(completed("cle", history, pmac_words), "CLEAR");
    EXPECT_EQ(completed("OPEN PROG1 CLE", history, pmac_words), "OPEN PROG1 CLEAR");
}

TEST(Completion, LeavesWhatItDoesNotKnow) {
    EXPECT_EQ(completed("Z", history, pmac_words), "Z");
    EXPECT_EQ(completed("#1J/", history, pmac_words), "#1J/");
    EXPECT_EQ(completed("", {}, {}), "");
}

} // namespace
} // namespace millwright::widgets
