// What a PMAC computes: numbers, variables, operators, functions, conditions. Angles are in degrees, as with
// I15=0.
#pragma once

#include "core/pmac/emulator/internal/lexer.h"

#include <memory>
#include <optional>

namespace millwright::pmac::card {

/// I, P, Q and M variables.
class Variables {
public:
    static constexpr int count = 1024;

    virtual ~Variables() = default;
    /// `kind` is one of IPQM, `index` 0 to 1023.
    [[nodiscard]] virtual double value(char kind, int index) const = 0;
    virtual void set(char kind, int index, double value) = 0;
};

class Expression {
public:
    Expression() = default;
    explicit Expression(double constant);

    /// Always finite: what has no value (a quotient by 0, a root of less than 0) is 0.
    [[nodiscard]] double value(const Variables& variables) const;
    [[nodiscard]] explicit operator bool() const { return node_ != nullptr; }

    struct Node;

private:
    friend class ExpressionReader;
    std::shared_ptr<const Node> node_;
};

/// Each stands behind what it read, or gives nothing.
[[nodiscard]] std::optional<Expression> take_expression(Words& words);
/// In parentheses, with =, >, <, ~ (within 0.5), their opposites, AND and OR; 1 or 0.
[[nodiscard]] std::optional<Expression> take_condition(Words& words);
/// What follows an axis letter: a number, or an expression in parentheses.
[[nodiscard]] std::optional<Expression> take_data(Words& words);

} // namespace millwright::pmac::card
