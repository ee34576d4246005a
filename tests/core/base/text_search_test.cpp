#include "core/base/text_search.h"

#include "core/base/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <random>
#include <string>
#include <vector>

namespace millwright {
namespace {

std::string small(std::string text) {
    for (char& c : text) {
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    return text;
}

/// By the standard library, place by place.
std::vector<std::size_t> places(const std::string& text, const std::string& wanted) {
    std::vector<std::size_t> found;
    const std::string in = small(text);
    const std::string what = small(wanted);
    for (auto at = in.find(what); at != std::string::npos; at = in.find(what, at + 1)) {
        found.push_back(at);
    }
    return found;
}

std::string random_text(std::mt19937& random, int length) {
    std::uniform_int_distribution<int> letter(0, 3);
    std::string text;
    for (int n = 0; n < length; ++n) {
        text += "aAbX"[letter(random)];
    }
    return text;
}

TEST(TextPattern, FindsEachPlaceThatTheStandardLibraryFinds) {
    std::mt19937 random(7);
    for (int round = 0; round < 300; ++round) {
        const std::string text = random_text(random, 200);
        const std::string wanted = random_text(random, 1 + round % 5);
        const TextPattern pattern(wanted);
        std::vector<std::size_t> forward, backward;
        for (auto at = pattern.next(text, 0); at; at = pattern.next(text, *at + 1)) {
            forward.push_back(*at);
        }
        for (auto at = pattern.previous(text, text.size()); at; at = pattern.previous(text, *at)) {
            backward.push_back(*at);
        }
        std::ranges::reverse(backward);
        EXPECT_EQ(forward, places(text, wanted)) << text << " / " << wanted;
        EXPECT_EQ(backward, forward) << text << " / " << wanted;
    }
}

std::vector<std::size_t> places_of(const TextPattern& pattern, const std::string& text) {
    std::vector<std::size_t> found;
    for (auto at = pattern.next(text, 0); at; at = pattern.next(text, *at + 1)) {
        found.push_back(*at);
    }
    std::vector<std::size_t> backward;
    for (auto at = pattern.previous(text, text.size()); at; at = pattern.previous(text, *at)) {
        backward.insert(backward.begin(), *at);
    }
    EXPECT_EQ(found, backward);
    TextCount count(text, pattern);
    while (!count.done()) {
        count.advance(1);
    }
    EXPECT_LE(count.count(), static_cast<std::int64_t>(found.size())); // overlaps count once
    return found;
}

TEST(TextPattern, TellsCapitalLettersAndWholeWordsApartWhereItShall) {
    const std::string text = "X10 x10 X100 aX10\nX10";
    using Places = std::vector<std::size_t>;
    EXPECT_EQ(places_of(TextPattern("x10"), text), (Places{0, 4, 8, 14, 18}));
    EXPECT_EQ(places_of(TextPattern("x10", {.same_case = true}), text), (Places{4}));
    EXPECT_EQ(places_of(TextPattern("x10", {.whole_words = true}), text), (Places{0, 4, 18}));
    EXPECT_EQ(places_of(TextPattern("X10", {.same_case = true, .whole_words = true}), text), (Places{0, 18}));
    // What is no letter needs no border.
    EXPECT_EQ(places_of(TextPattern(";", {.whole_words = true}), "X1;;Y"), (Places{2, 3}));
}

TEST(TextPattern, PutsAnotherTextInEveryPlace) {
    const ReplacedText all = replaced_everywhere("aXaxa", TextPattern("x"), "xx");
    EXPECT_EQ(all.text, "axxaxxa");
    EXPECT_EQ(all.count, 2);
    EXPECT_EQ(replaced_everywhere("aaa", TextPattern("aa"), "b").text, "ba");
    EXPECT_EQ(replaced_everywhere("X1 X10", TextPattern("X1", {.whole_words = true}), "").text, " X10");
    EXPECT_EQ(replaced_everywhere("none", TextPattern("x"), "y").count, 0);
    EXPECT_EQ(replaced_everywhere("", TextPattern("x"), "y").text, "");
}

TEST(TextPattern, FindsAPlaceFarBack) {
    const std::string text = "needle" + std::string(200'000, ' ');
    EXPECT_EQ(TextPattern("NEEDLE").previous(text, text.size()), 0U);
    EXPECT_EQ(TextPattern("other").previous(text, text.size()), std::nullopt);
}

TEST(TextPattern, MayNotBeEmpty) {
    EXPECT_THROW(TextPattern(""), Defect);
}

TEST(TextCount, CountsTheSameInSmallStepsAsInOne) {
    std::mt19937 random(11);
    const std::string text = random_text(random, 5000);
    TextCount whole(text, TextPattern("ab"));
    whole.advance(text.size());
    TextCount steps(text, TextPattern("ab"));
    while (!steps.done()) {
        steps.advance(7);
    }
    EXPECT_TRUE(whole.done());
    EXPECT_EQ(steps.count(), whole.count());
    EXPECT_EQ(whole.count(), std::ssize(places(text, "ab")));
}

} // namespace
} // namespace millwright
