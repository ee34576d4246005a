#include "core/pmac/emulator/internal/expression.h"

#include "core/base/numbers.h"
#include "core/base/units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

namespace millwright::pmac::card {

struct Expression::Node {
    std::string op; ///< empty: the constant; a letter of IPQM: the variable that `left` numbers
    double constant = 0.0;
    std::shared_ptr<const Node> left, right;
};

namespace {

using Node = Expression::Node;
using NodePtr = std::shared_ptr<const Node>;

constexpr int deepest = 60; // nested parentheses and signs

double finite(double value) {
    return std::isfinite(value) ? value : 0.0;
}

long long integer_part(double value) {
    constexpr double most = 9e15;
    return static_cast<long long>(std::clamp(value, -most, most));
}

/// 0 where it has no value.
double function(const std::string& name, double a) {
    if (name == "SIN") {
        return std::sin(from_degrees(a));
    }
    if (name == "COS") {
        return std::cos(from_degrees(a));
    }
    if (name == "TAN") {
        return std::tan(from_degrees(a));
    }
    if (name == "ASIN") {
        return std::abs(a) <= 1.0 ? to_degrees(std::asin(a)) : 0.0;
    }
    if (name == "ACOS") {
        return std::abs(a) <= 1.0 ? to_degrees(std::acos(a)) : 0.0;
    }
    if (name == "ATAN") {
        return to_degrees(std::atan(a));
    }
    if (name == "SQRT") {
        return a >= 0.0 ? std::sqrt(a) : 0.0;
    }
    if (name == "EXP") {
        constexpr double largest = 700.0; // of which a double has the result
        return a <= largest ? std::exp(a) : 0.0;
    }
    if (name == "LN") {
        return a > 0.0 ? std::log(a) : 0.0;
    }
    return name == "INT" ? std::floor(a) : std::abs(a);
}

bool compare(const std::string& op, double a, double b) {
    constexpr double near = 0.5;
    const bool denied = op.front() == '!';
    switch (op.back()) {
    case '>':
        return (a > b) != denied;
    case '<':
        return (a < b) != denied;
    case '~':
        return (std::abs(a - b) < near) != denied;
    default:
        return (!(a < b) && !(a > b)) != denied;
    }
}

/// A division by 0 gives 0.
double arithmetic(const std::string& op, double a, double b) {
    switch (op.front()) {
    case '+':
        return a + b;
    case '-':
        return a - b;
    case '*':
        return a * b;
    case '/':
        return exactly_equal(b, 0.0) ? 0.0 : a / b;
    case '%':
        return exactly_equal(b, 0.0) ? 0.0 : std::fmod(a, b);
    case '&':
        return static_cast<double>(integer_part(a) & integer_part(b));
    case '|':
        return static_cast<double>(integer_part(a) | integer_part(b));
    default:
        return static_cast<double>(integer_part(a) ^ integer_part(b));
    }
}

double evaluate(const Node& node, const Variables& variables) {
    if (node.op.empty()) {
        return node.constant;
    }
    const double a = evaluate(*node.left, variables);
    const std::string& op = node.op;
    if (op.size() == 1 && std::string_view("IPQM").find(op.front()) != std::string_view::npos) {
        const bool exists = a >= 0.0 && a < Variables::count;
        return exists ? finite(variables.value(op.front(), static_cast<int>(a))) : 0.0;
    }
    if (!node.right) {
        return finite(op == "NEGATE" ? -a : function(op, a));
    }
    const double b = evaluate(*node.right, variables);
    if (op == "AND" || op == "OR") {
        const bool both = a > 0.0 && b > 0.0;
        return (op == "AND" ? both : a > 0.0 || b > 0.0) ? 1.0 : 0.0;
    }
    const bool compares = op.front() == '!' || op.find_first_of("=<>~") != std::string::npos;
    return compares ? (compare(op, a, b) ? 1.0 : 0.0) : finite(arithmetic(op, a, b));
}

NodePtr make(std::string op, NodePtr left, NodePtr right = {}) {
    return left ? std::make_shared<const Node>(Node{std::move(op), 0.0, std::move(left), std::move(right)})
                : nullptr;
}

/// Whether it is true or false, and no number.
bool is_condition(const NodePtr& node) {
    return node->op == "AND" || node->op == "OR" || node->op.find_first_of("=<>~") != std::string::npos;
}

NodePtr constant(double value) {
    return std::make_shared<const Node>(Node{{}, value, {}, {}});
}

} // namespace

class ExpressionReader {
public:
    explicit ExpressionReader(Words& words) : words_(words) {}

    std::optional<Expression> number(NodePtr node) const {
        Expression result;
        result.node_ = std::move(node);
        return result.node_ && !is_condition(result.node_) ? std::optional(result) : std::nullopt;
    }
    std::optional<Expression> truth(NodePtr node) const {
        Expression result;
        result.node_ = std::move(node);
        return result.node_ && is_condition(result.node_) ? std::optional(result) : std::nullopt;
    }

    NodePtr sum() {
        NodePtr left = product();
        while (left && (words_.at("+") || words_.at("-") || words_.at("|") || words_.at("^"))) {
            left = joined(left, [this] { return product(); });
        }
        return left;
    }

    NodePtr condition() {
        NodePtr left = all_of();
        while (left && words_.at("OR")) {
            left = joined(left, [this] { return all_of(); });
        }
        return left;
    }

    /// A number or a condition.
    NodePtr in_parentheses() {
        if (!words_.take("(") || ++depth_ > deepest) {
            return nullptr;
        }
        NodePtr inside = condition();
        --depth_;
        return words_.take(")") ? inside : nullptr;
    }

private:
    Words& words_;
    int depth_ = 0;

    template <class Right> NodePtr joined(const NodePtr& left, const Right& right) {
        std::string op = words_.now().text;
        words_.skip();
        NodePtr second = right();
        const bool combines = op == "AND" || op == "OR";
        const bool fits = second && is_condition(left) == combines && is_condition(second) == combines;
        return fits ? make(std::move(op), left, std::move(second)) : nullptr;
    }

    NodePtr product() {
        NodePtr left = factor();
        while (left && (words_.at("*") || words_.at("/") || words_.at("%") || words_.at("&"))) {
            left = joined(left, [this] { return factor(); });
        }
        return left;
    }

    NodePtr factor() {
        if (++depth_ > deepest) {
            return nullptr;
        }
        NodePtr result = words_.take("-") ? negated(factor()) : term();
        --depth_;
        return result;
    }

    static NodePtr negated(NodePtr value) {
        return value && !is_condition(value) ? make("NEGATE", std::move(value)) : nullptr;
    }

    NodePtr term() {
        (void)words_.take("+");
        if (words_.at_number()) {
            const double value = words_.now().value;
            words_.skip();
            return constant(value);
        }
        if (words_.at("(")) {
            return in_parentheses();
        }
        return words_.at("I") || words_.at("P") || words_.at("Q") || words_.at("M") ? variable() : call();
    }

    NodePtr variable() {
        std::string kind = words_.now().text;
        words_.skip();
        if (words_.at("(")) {
            return make(std::move(kind), in_parentheses());
        }
        const auto index = words_.take_index(Variables::count - 1);
        return index ? make(std::move(kind), constant(*index)) : nullptr;
    }

    NodePtr call() {
        constexpr std::array<std::string_view, 11> names{
            "SIN", "COS", "TAN", "ASIN", "ACOS", "ATAN", "SQRT", "EXP", "LN", "INT", "ABS"};
        for (const std::string_view name : names) {
            if (words_.take(name)) {
                return make(std::string(name), in_parentheses());
            }
        }
        return nullptr;
    }

    NodePtr all_of() {
        NodePtr left = comparison();
        while (left && words_.at("AND")) {
            left = joined(left, [this] { return comparison(); });
        }
        return left;
    }

    NodePtr comparison() {
        const NodePtr left = sum();
        if (!left) {
            return nullptr;
        }
        if (words_.at("!") && words_.next().text == "~") {
            words_.skip();
            words_.skip();
            words_.skip();
            NodePtr second = sum();
            return second ? make("!~", left, std::move(second)) : nullptr;
        }
        for (const std::string_view op :
             std::array<std::string_view, 7>{"=", ">", "<", "~", "!=", "!>", "!<"}) {
            if (words_.at(op)) {
                return joined(left, [this] { return sum(); });
            }
        }
        return left;
    }
};

Expression::Expression(double constant) : node_(card::constant(constant)) {}

double Expression::value(const Variables& variables) const {
    return node_ ? evaluate(*node_, variables) : 0.0;
}

std::optional<Expression> take_expression(Words& words) {
    ExpressionReader reader(words);
    return reader.number(reader.sum());
}

std::optional<Expression> take_condition(Words& words) {
    ExpressionReader reader(words);
    return reader.truth(reader.in_parentheses());
}

std::optional<Expression> take_data(Words& words) {
    if (words.at("(")) {
        ExpressionReader reader(words);
        return reader.number(reader.in_parentheses());
    }
    const auto value = words.take_number();
    return value ? std::optional(Expression(*value)) : std::nullopt;
}

} // namespace millwright::pmac::card
