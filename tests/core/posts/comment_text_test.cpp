#include "core/posts/internal/comment_text.h"

#include <gtest/gtest.h>

namespace millwright::posts::internal {
namespace {

std::string one(std::string_view text) {
    const auto lines = comment_lines(text);
    return lines.size() == 1 ? lines.front() : "not one line";
}

TEST(CommentText, ReplacesParenthesesAndEverythingOutsideOfAscii) {
    EXPECT_EQ(one("project: dome (old)\t\xE0\xB9\x82\xE0\xB8\x94 \x01"), "(project: dome [old] ?? ?)");
}

TEST(CommentText, BreaksLongTextAtSpacesAndLosesNoWord) {
    std::string text;
    for (int n = 0; n < 60; ++n) {
        text += "word" + std::to_string(n) + " ";
    }
    text.pop_back();
    std::string joined;
    for (const std::string& line : comment_lines(text)) {
        EXPECT_LE(line.size(), 100U);
        joined += (joined.empty() ? "" : " ") + line.substr(1, line.size() - 2);
    }
    EXPECT_EQ(joined, text);
}

TEST(CommentText, NeverStartsACommentThatLinuxCncActsUpon) {
    EXPECT_EQ(one("msg, hello"), "(- msg, hello)");
    EXPECT_EQ(one(" D E BUG,#1"), "(-  D E BUG,#1)");
    EXPECT_EQ(one("logopen,/etc/x"), "(- logopen,/etc/x)");
}

TEST(CommentText, MakesOneLineOfNothing) {
    EXPECT_EQ(one(""), "()");
}

} // namespace
} // namespace millwright::posts::internal
