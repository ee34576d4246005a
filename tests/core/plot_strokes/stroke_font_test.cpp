#include "core/plot_strokes/stroke_font.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace millwright::plot {
namespace {

TEST(StrokeFont, HasEveryPrintingCharacterInsideItsCell) {
    for (char c = ' '; c <= '~'; ++c) {
        const auto lines = glyph(c);
        ASSERT_TRUE(lines) << c;
        EXPECT_EQ(lines->empty(), c == ' ');
        for (const auto& line : *lines) {
            EXPECT_GE(line.size(), 2U) << c;
            for (const Vec2& p : line) {
                EXPECT_TRUE(p.x() >= 0.0 && p.x() <= 1.0 && p.y() >= -0.5 && p.y() <= 1.0) << c;
            }
        }
    }
    EXPECT_FALSE(glyph('\x7f'));
    EXPECT_FALSE(glyph('\n'));
    EXPECT_FALSE(glyph('\xe4'));
}

TEST(StrokeFont, NoTwoCharactersLookAlike) {
    std::set<std::string> seen;
    for (char c = '!'; c <= '~'; ++c) {
        std::string shape;
        const Glyph lines = glyph(c).value();
        for (const auto& line : lines) {
            for (const Vec2& p : line) {
                shape += std::to_string(p.x()) + " " + std::to_string(p.y()) + " ";
            }
            shape += "/";
        }
        EXPECT_TRUE(seen.insert(shape).second) << c;
    }
}

} // namespace
} // namespace millwright::plot
