#include "core/gcode/internal/cursor.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <string>

namespace millwright::gcode::internal {
namespace {

double number_of(const std::string& text) {
    Cursor cursor{std::string_view(text)};
    return read_number(cursor);
}

TEST(Number, IsRoundedLikeTheCLibraryDoes) {
    std::mt19937_64 random(274);
    std::uniform_int_distribution<int> digits(1, 25);
    std::uniform_int_distribution<int> digit('0', '9');
    for (int n = 0; n < 20'000; ++n) {
        std::string text;
        const int count = digits(random);
        for (int k = 0; k < count; ++k) {
            text += static_cast<char>(digit(random));
        }
        text.insert(static_cast<std::size_t>(digits(random) % (count + 1)), ".");
        ASSERT_EQ(number_of(text), std::strtod(text.c_str(), nullptr)) << text;
    }
}

TEST(Number, GoesOnBehindBlanks) {
    EXPECT_DOUBLE_EQ(number_of("1 2 . 5"), 12.5);
    EXPECT_DOUBLE_EQ(number_of("- 3"), -3.0);
    Cursor cursor{std::string_view("1.5 Y2")};
    EXPECT_DOUBLE_EQ(read_number(cursor), 1.5);
    EXPECT_EQ(cursor.peek(), 'Y');
}

TEST(Number, HasNoExponent) {
    Cursor cursor{std::string_view("1E5")};
    EXPECT_DOUBLE_EQ(read_number(cursor), 1.0);
    EXPECT_EQ(cursor.peek(), 'E');
}

TEST(Number, RefusesWhatIsNone) {
    for (const char* text : {"", ".", "-", "+-5", "1.2.3", "..1", "abc"}) {
        EXPECT_THROW(static_cast<void>(number_of(text)), Refusal) << text;
    }
    EXPECT_THROW(static_cast<void>(number_of(std::string(400, '9'))), Refusal);
}

} // namespace
} // namespace millwright::gcode::internal
