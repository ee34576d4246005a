#include "core/gcode/internal/expression.h"

#include "core/base/numbers.h"
#include "core/base/units.h"
#include "core/gcode/internal/cursor.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace millwright::gcode::internal {

namespace {

constexpr int deepest_nesting = 60;

/// Numbers that differ by less are equal for EQ and NE (LinuxCNC's TOLERANCE_EQUAL).
constexpr double equal_within = 1e-4;

double read_any(Cursor& cursor, const Variables& variables);

// ---- operators

using Apply = double (*)(double, double, int column);

struct Operator {
    std::string_view sign;
    int precedence;
    Apply apply;
};

constexpr double truth(bool holds) {
    return holds ? 1.0 : 0.0;
}

bool is_true(double value) {
    return !exactly_equal(value, 0.0);
}

bool nearly_equal(double a, double b) {
    return std::abs(a - b) < equal_within;
}

double power(double a, double b, int column) {
    if (a < 0.0 && !exactly_equal(std::floor(b), b)) {
        refuse(column, "a negative number can only be raised to an integer power");
    }
    return std::pow(a, b);
}

double divide(double a, double b, int column) {
    if (exactly_equal(b, 0.0)) {
        refuse(column, "division by zero");
    }
    return a / b;
}

double modulo(double a, double b, int column) {
    if (exactly_equal(b, 0.0)) {
        refuse(column, "MOD by zero");
    }
    const double rest = std::fmod(a, b);
    return rest < 0.0 ? rest + std::abs(b) : rest;
}

// Longer signs first where one begins like another.
constexpr std::array<Operator, 16> operators{{
    {"**", 5, power},
    {"*", 4, [](double a, double b, int) { return a * b; }},
    {"/", 4, divide},
    {"MOD", 4, modulo},
    {"+", 3, [](double a, double b, int) { return a + b; }},
    {"-", 3, [](double a, double b, int) { return a - b; }},
    {"EQ", 2, [](double a, double b, int) { return truth(nearly_equal(a, b)); }},
    {"NE", 2, [](double a, double b, int) { return truth(!nearly_equal(a, b)); }},
    {"GT", 2, [](double a, double b, int) { return truth(a > b); }},
    {"GE", 2, [](double a, double b, int) { return truth(a >= b); }},
    {"LT", 2, [](double a, double b, int) { return truth(a < b); }},
    {"LE", 2, [](double a, double b, int) { return truth(a <= b); }},
    {"AND", 1, [](double a, double b, int) { return truth(is_true(a) && is_true(b)); }},
    {"OR", 1, [](double a, double b, int) { return truth(is_true(a) || is_true(b)); }},
    {"XOR", 1, [](double a, double b, int) { return truth(is_true(a) != is_true(b)); }},
    {"]", 0, nullptr},
}};

const Operator& read_operator(Cursor& cursor) {
    for (const Operator& candidate : operators) {
        if (cursor.take_word(candidate.sign)) {
            return candidate;
        }
    }
    if (cursor.at_end()) {
        refuse(cursor.column(), "the closing ] of the expression is missing");
    }
    refuse(cursor.column(),
           "an operator or ] is expected",
           "use one of + - * / ** MOD AND OR XOR EQ NE GT GE LT LE");
}

double checked(double value, int column) {
    if (!std::isfinite(value)) {
        refuse(column, "the result is too large or not a number");
    }
    return value;
}

/// Folds everything that binds more tightly than `precedence` into `left`; `next` is the operator behind it.
double fold(double left, const Operator*& next, int precedence, Cursor& cursor, const Variables& variables) {
    while (next->precedence > precedence) {
        const Operator& now = *next;
        const int column = cursor.column();
        double right = read_any(cursor, variables);
        next = &read_operator(cursor);
        right = fold(right, next, now.precedence, cursor, variables);
        left = checked(now.apply(left, right, column), column);
    }
    return left;
}

// ---- functions of one value, in brackets

using Function = double (*)(double, int column);

struct NamedFunction {
    std::string_view name;
    Function apply;
};

void expect_sine(double x, int column) {
    if (!(x >= -1.0 && x <= 1.0)) {
        refuse(column, "the argument of ASIN and ACOS must be from -1 to 1");
    }
}

double square_root(double x, int column) {
    if (x < 0.0) {
        refuse(column, "a negative number has no square root");
    }
    return std::sqrt(x);
}

double logarithm(double x, int column) {
    if (!(x > 0.0)) {
        refuse(column, "the argument of LN must be greater than 0");
    }
    return std::log(x);
}

double arc_sine(double x, int column) {
    expect_sine(x, column);
    return to_degrees(std::asin(x));
}

double arc_cosine(double x, int column) {
    expect_sine(x, column);
    return to_degrees(std::acos(x));
}

constexpr std::array<NamedFunction, 12> functions{{
    {"ABS", [](double x, int) { return std::abs(x); }},
    {"ACOS", arc_cosine},
    {"ASIN", arc_sine},
    {"COS", [](double x, int) { return std::cos(from_degrees(x)); }},
    {"EXP", [](double x, int) { return std::exp(x); }},
    {"FIX", [](double x, int) { return std::floor(x); }},
    {"FUP", [](double x, int) { return std::ceil(x); }},
    {"LN", logarithm},
    {"ROUND", [](double x, int) { return std::round(x); }},
    {"SIN", [](double x, int) { return std::sin(from_degrees(x)); }},
    {"SQRT", square_root},
    {"TAN", [](double x, int) { return std::tan(from_degrees(x)); }},
}};

/// ATAN[y]/[x], in degrees.
double read_arc_tangent(Cursor& cursor, const Variables& variables) {
    const double y = read_bracketed(cursor, variables);
    if (!cursor.take('/')) {
        refuse(cursor.column(), "the / of ATAN[y]/[x] is missing");
    }
    const double x = read_bracketed(cursor, variables);
    return to_degrees(std::atan2(y, x));
}

/// EXISTS[#<name>] or EXISTS[#number].
double read_exists(Cursor& cursor, const Variables& variables) {
    if (!cursor.take('[') || !cursor.take('#')) {
        refuse(cursor.column(), "EXISTS needs a parameter: EXISTS[#<name>]");
    }
    const bool exists = cursor.peek() == '<' ? variables.named(read_name(cursor)).has_value()
                                             : Variables::is_number(read_integer(cursor, variables));
    if (!cursor.take(']')) {
        refuse(cursor.column(), "the closing ] of the expression is missing");
    }
    return truth(exists);
}

double read_function(Cursor& cursor, const Variables& variables) {
    const int column = cursor.column();
    if (cursor.take_word("ATAN")) {
        return read_arc_tangent(cursor, variables);
    }
    if (cursor.take_word("EXISTS")) {
        return read_exists(cursor, variables);
    }
    for (const NamedFunction& function : functions) {
        if (cursor.take_word(function.name)) {
            return function.apply(read_bracketed(cursor, variables), column);
        }
    }
    refuse(column,
           "a number or a function is expected",
           "use a number, or one of ABS ACOS ASIN ATAN COS EXISTS EXP FIX FUP LN ROUND SIN SQRT TAN");
}

double read_parameter(Cursor& cursor, const Variables& variables) {
    const int column = cursor.column();
    cursor.advance();
    if (cursor.peek() != '<') {
        const int number = read_integer(cursor, variables);
        const double value = variables.numbered(number, column);
        variables.note_read(number, column);
        return value;
    }
    const std::string name = read_name(cursor);
    const auto value = variables.named(name);
    if (!value) {
        refuse(column,
               fmt::format("the parameter #<{}> is not defined", name),
               "assign the parameter in an earlier line: parameters are set after the whole line is read");
    }
    variables.note_read(name, column);
    return *value;
}

bool begins_number(Cursor cursor) {
    cursor.advance();
    const char c = cursor.peek();
    return is_digit(c) || c == '.';
}

double read_signed(Cursor& cursor, const Variables& variables) {
    if (begins_number(cursor)) {
        return read_number(cursor);
    }
    const bool negative = cursor.peek() == '-';
    cursor.advance();
    const double value = read_any(cursor, variables);
    return negative ? -value : value;
}

class Deeper {
public:
    explicit Deeper(Cursor& cursor) : cursor_(cursor) {
        if (++cursor_.depth > deepest_nesting) {
            refuse(cursor_.column(), fmt::format("nested more than {} deep", deepest_nesting));
        }
    }
    Deeper(const Deeper&) = delete;
    Deeper& operator=(const Deeper&) = delete;
    ~Deeper() { --cursor_.depth; }

private:
    Cursor& cursor_;
};

double read_any(Cursor& cursor, const Variables& variables) {
    const char c = cursor.peek();
    if (is_digit(c) || c == '.') {
        return read_number(cursor);
    }
    const Deeper deeper(cursor);
    switch (c) {
    case '+':
    case '-':
        return read_signed(cursor, variables);
    case '[':
        return read_bracketed(cursor, variables);
    case '#':
        return read_parameter(cursor, variables);
    case '\0':
        refuse(cursor.column(), "the line ends where a value is expected");
    default:
        return read_function(cursor, variables);
    }
}

} // namespace

double read_value(Cursor& cursor, const Variables& variables) {
    const int column = cursor.column();
    return checked(read_any(cursor, variables), column);
}

double read_bracketed(Cursor& cursor, const Variables& variables) {
    if (!cursor.take('[')) {
        refuse(cursor.column(), "[ is expected");
    }
    const double first = read_any(cursor, variables);
    const Operator* next = &read_operator(cursor);
    return fold(first, next, 0, cursor, variables);
}

int read_integer(Cursor& cursor, const Variables& variables) {
    cursor.skip_blanks();
    const int column = cursor.column();
    const double value = read_value(cursor, variables);
    constexpr double largest = 1e9;
    const double whole = std::round(value);
    if (!(std::abs(value) <= largest) || std::abs(value - whole) > whole_within) {
        refuse(column, "an integer is expected");
    }
    return static_cast<int>(whole);
}

std::string read_name(Cursor& cursor) {
    const int column = cursor.column();
    cursor.advance();
    std::string name;
    for (char c = cursor.peek(); c != '>'; c = cursor.peek()) {
        if (c == '\0') {
            refuse(column, "the closing > of the name is missing");
        }
        name += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
        cursor.advance();
    }
    cursor.advance();
    return name;
}

} // namespace millwright::gcode::internal
