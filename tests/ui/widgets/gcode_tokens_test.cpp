#include "ui/widgets/listing.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <utility>
#include <vector>

namespace millwright::widgets {
namespace {

using Pieces = std::vector<std::pair<std::string, CodeKind>>;

Pieces pieces(std::string_view line) {
    Pieces found;
    while (!line.empty()) {
        const CodeToken token = first_token(line);
        if (token.kind != CodeKind::blank) {
            found.emplace_back(line.substr(0, token.length), token.kind);
        }
        line.remove_prefix(token.length);
    }
    return found;
}

TEST(GcodeTokens, CutsWordsWithAndWithoutBlanks) {
    const Pieces expected{{"N10", CodeKind::line_number},
                          {"G1", CodeKind::g_word},
                          {"x-1.5", CodeKind::axis_word},
                          {"Y2", CodeKind::axis_word},
                          {"F100", CodeKind::parameter},
                          {"M3", CodeKind::m_word}};
    EXPECT_EQ(pieces("N10 G1 x-1.5 Y2 F100 M3"), expected);
    EXPECT_EQ(pieces("N10G1x-1.5Y2F100M3"), expected);
}

TEST(GcodeTokens, KeepsCommentsWhole) {
    EXPECT_EQ(
        pieces("(G1 X2) G0 ; X1 (y"),
        (Pieces{{"(G1 X2)", CodeKind::comment}, {"G0", CodeKind::g_word}, {"; X1 (y", CodeKind::comment}}));
    EXPECT_EQ(pieces("(never closed G1"), (Pieces{{"(never closed G1", CodeKind::comment}}));
}

TEST(GcodeTokens, KnowsFlowOfControlAndExpressions) {
    EXPECT_EQ(pieces("o100 while [#1 LT [2+3]]"),
              (Pieces{{"o100 while", CodeKind::o_word}, {"[#1 LT [2+3]]", CodeKind::expression}}));
    EXPECT_EQ(pieces("O<probe> call [1]"),
              (Pieces{{"O<probe> call", CodeKind::o_word}, {"[1]", CodeKind::expression}}));
    EXPECT_EQ(pieces("#<depth>=[2*3] X#5"),
              (Pieces{{"#<depth>=", CodeKind::expression},
                      {"[2*3]", CodeKind::expression},
                      {"X", CodeKind::axis_word},
                      {"#5", CodeKind::expression}}));
}

TEST(GcodeTokens, CutAnyBytesIntoPiecesThatMakeUpTheLine) {
    std::mt19937 random(5);
    std::uniform_int_distribution<int> byte(1, 255);
    for (int round = 0; round < 2000; ++round) {
        std::string line;
        for (int n = 0; n < round % 40; ++n) {
            line += static_cast<char>(byte(random));
        }
        std::string_view rest = line;
        while (!rest.empty()) {
            const CodeToken token = first_token(rest);
            ASSERT_GE(token.length, 1U);
            ASSERT_LE(token.length, rest.size());
            rest.remove_prefix(token.length);
        }
    }
}

} // namespace
} // namespace millwright::widgets
