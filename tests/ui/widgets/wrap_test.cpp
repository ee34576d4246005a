#include "ui/widgets/internal/draw.h"

#include <gtest/gtest.h>

#include <string_view>

namespace millwright::widgets {
namespace {

/// Each letter 1 wide.
float letters(std::string_view text) {
    return static_cast<float>(text.size());
}

TEST(Wrap, BreaksNoNumberAtItsPoint) {
    EXPECT_EQ(broken_at_blanks("it would be 1450.141 mm away", 17.0F, letters),
              "it would be\n1450.141 mm away");
}

TEST(Wrap, FillsEachLineAndKeepsTheLinesThereAre) {
    EXPECT_EQ(broken_at_blanks("a bc d\ne f g h", 4.0F, letters), "a bc\nd\ne f\ng h");
    EXPECT_EQ(broken_at_blanks("", 4.0F, letters), "");
}

TEST(Wrap, LeavesAWordThatIsTooLong) {
    EXPECT_EQ(broken_at_blanks("no: tcp:127.0.0.1:1025 answers", 8.0F, letters),
              "no:\ntcp:127.0.0.1:1025\nanswers");
}

} // namespace
} // namespace millwright::widgets
