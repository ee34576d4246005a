#include "ui/widgets/arithmetic.h"

#include <gtest/gtest.h>

#include <string>

namespace millwright::widgets {
namespace {

TEST(Arithmetic, GivesTheValueOfWhatPeopleType) {
    EXPECT_DOUBLE_EQ(evaluate("25.4/2").value.value(), 12.7);
    EXPECT_DOUBLE_EQ(evaluate("(3+4)*2").value.value(), 14.0);
    EXPECT_DOUBLE_EQ(evaluate(" -1.5e2 ").value.value(), -150.0);
    EXPECT_DOUBLE_EQ(evaluate("2^10").value.value(), 1024.0);
    EXPECT_DOUBLE_EQ(evaluate("sqrt(16)").value.value(), 4.0);
}

TEST(Arithmetic, IgnoresTheUnitOfTheField) {
    EXPECT_DOUBLE_EQ(evaluate("12.7 mm", "mm").value.value(), 12.7);
    EXPECT_DOUBLE_EQ(evaluate("90°", "°").value.value(), 90.0);
    EXPECT_FALSE(evaluate("12.7 mm", "°").value.has_value());
}

TEST(Arithmetic, RefusesWhatIsNoFiniteNumberAndSaysWhy) {
    for (const char* text : {"abc",
                             "1/0",
                             "0/0",
                             "nan",
                             "inf",
                             "1e999",
                             "-1e999",
                             "",
                             "  ",
                             "1+",
                             "(2",
                             "2 3",
                             "sqrt(-1)",
                             "ln(0)",
                             "\"a\"",
                             "a=3",
                             "@#",
                             "\xff\xfe"}) {
        const Evaluated found = evaluate(text);
        EXPECT_FALSE(found.value.has_value()) << text;
        EXPECT_FALSE(found.reason.empty()) << text;
    }
}

TEST(Arithmetic, ADecimalCommaIsRefusedNotReadAsAnotherNumber) {
    const Evaluated found = evaluate("25,4");
    EXPECT_FALSE(found.value.has_value());
    EXPECT_EQ(found.reason, "Use a decimal point, not a comma.");
}

TEST(Arithmetic, DeepNestingIsRefusedNotACrash) {
    EXPECT_FALSE(evaluate(std::string(100'000, '(')).value.has_value());
    EXPECT_FALSE(evaluate(std::string(255, '(')).value.has_value());
}

TEST(Arithmetic, TheRangeIsPartOfTheReason) {
    const FieldInfo info{
        .id = "feed", .label = "Feed", .unit = "mm/min", .tip = "", .min = 1.0, .max = 5000.0};
    EXPECT_EQ(evaluate_number("0", info).reason, "Must be from 1 to 5000 mm/min.");
    EXPECT_EQ(evaluate_number("5000.1", info).reason, "Must be from 1 to 5000 mm/min.");
    EXPECT_DOUBLE_EQ(evaluate_number("5000", info).value.value(), 5000.0);
    const FieldInfo at_least{.id = "n", .label = "n", .unit = "", .tip = "", .min = 2.0};
    EXPECT_EQ(evaluate_number("1", at_least).reason, "Must be at least 2.");
    const FieldInfo line{.id = "line", .label = "Line", .unit = "of 12", .tip = "", .min = 1.0, .max = 12.0};
    EXPECT_EQ(evaluate_integer("13", line).reason, "Must be from 1 to 12.");
}

TEST(Arithmetic, AWholeNumberIsWhole) {
    const FieldInfo info{.id = "nu", .label = "Nodes", .unit = "", .tip = "", .min = 2.0, .max = 400.0};
    EXPECT_DOUBLE_EQ(evaluate_integer("10*2", info).value.value(), 20.0);
    EXPECT_DOUBLE_EQ(evaluate_integer("3*(1/3)*7", info).value.value(), 7.0);
    EXPECT_EQ(evaluate_integer("2.5", info).reason, "Must be a whole number.");
    EXPECT_EQ(evaluate_integer("1", info).reason, "Must be from 2 to 400.");
}

} // namespace
} // namespace millwright::widgets
