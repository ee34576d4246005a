#include "core/gcode/internal/expression.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace millwright::gcode::internal {
namespace {

double value_of(const std::string& text) {
    const ModalState state;
    Variables variables(state);
    variables.set(1, 7.0);
    variables.set(7, 3.5);
    variables.set("depth", -4.0);
    variables.set("_shared", 9.0);
    Cursor cursor{std::string_view(text)};
    const double value = read_value(cursor, variables);
    EXPECT_TRUE(cursor.at_end()) << text;
    return value;
}

TEST(Expression, BindsTighterFirstAndFromTheLeft) {
    EXPECT_DOUBLE_EQ(value_of("[1+2*3]"), 7.0);
    EXPECT_DOUBLE_EQ(value_of("[2**3**2]"), 64.0);
    EXPECT_DOUBLE_EQ(value_of("[10-4-3]"), 3.0);
    EXPECT_DOUBLE_EQ(value_of("[8/4/2]"), 1.0);
    EXPECT_DOUBLE_EQ(value_of("[1+1 EQ 2]"), 1.0);
    EXPECT_DOUBLE_EQ(value_of("[1 OR 0 AND 0]"), 0.0);
    EXPECT_DOUBLE_EQ(value_of("[1 GT 0 AND 2 GT 3]"), 0.0);
    EXPECT_DOUBLE_EQ(value_of("[2*3**2+1 LT 20 XOR 0]"), 1.0);
}

TEST(Expression, ModuloIsNeverNegative) {
    EXPECT_DOUBLE_EQ(value_of("[-7 MOD 3]"), 2.0);
    EXPECT_DOUBLE_EQ(value_of("[7 MOD -3]"), 1.0);
}

TEST(Expression, FunctionsCalculateInDegrees) {
    EXPECT_NEAR(value_of("SIN[30]"), 0.5, 1e-15);
    EXPECT_NEAR(value_of("ATAN[1]/[-1]"), 135.0, 1e-12);
    EXPECT_NEAR(value_of("acos[0.5]"), 60.0, 1e-12);
    EXPECT_DOUBLE_EQ(value_of("FIX[-2.8]"), -3.0);
    EXPECT_DOUBLE_EQ(value_of("FUP[-2.2]"), -2.0);
    EXPECT_DOUBLE_EQ(value_of("ROUND[-2.5]"), -3.0);
    EXPECT_DOUBLE_EQ(value_of("LN[EXP[2]]"), 2.0);
}

TEST(Expression, SignsStandBeforeAnything) {
    EXPECT_DOUBLE_EQ(value_of("-[1+1]"), -2.0);
    EXPECT_DOUBLE_EQ(value_of("-#1"), -7.0);
    EXPECT_DOUBLE_EQ(value_of("--5"), 5.0);
    EXPECT_DOUBLE_EQ(value_of("+-.5"), -0.5);
    EXPECT_DOUBLE_EQ(value_of("-SQRT[4]"), -2.0);
}

TEST(Expression, ParametersAreReadByNumberAndByName) {
    EXPECT_DOUBLE_EQ(value_of("#1"), 7.0);
    EXPECT_DOUBLE_EQ(value_of("##1"), 3.5);
    EXPECT_DOUBLE_EQ(value_of("#[3+4]"), 3.5);
    EXPECT_DOUBLE_EQ(value_of("# < De Pth >"), -4.0);
    EXPECT_DOUBLE_EQ(value_of("#<_shared>"), 9.0);
    EXPECT_DOUBLE_EQ(value_of("EXISTS[#<depth>]"), 1.0);
    EXPECT_DOUBLE_EQ(value_of("EXISTS[#<none>]"), 0.0);
    EXPECT_DOUBLE_EQ(value_of("EXISTS[#5602]"), 0.0);
}

TEST(Expression, BlanksMeanNothing) {
    EXPECT_DOUBLE_EQ(value_of("[ 1 . 5 + s i n [ 9 0 ] ]"), 2.5);
}

TEST(Expression, RefusesWithTheColumn) {
    const ModalState state;
    const Variables variables(state);
    Cursor cursor{std::string_view("[1 + SQRT[-4]]")};
    try {
        static_cast<void>(read_value(cursor, variables));
        FAIL() << "no refusal";
    } catch (const Refusal& refusal) {
        EXPECT_EQ(refusal.column, 6);
        EXPECT_EQ(refusal.rule, "a negative number has no square root");
    }
}

} // namespace
} // namespace millwright::gcode::internal
