#include "core/grid/expression_weight.h"

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/grid/grid.h"

#include <muParser.h>

#include <array>
#include <cfenv>
#include <cmath>
#include <regex>
#include <utility>

namespace millwright::grid {

namespace {

constexpr std::size_t longest_expression = 500;
constexpr double difference_step = 1e-5; // of a uniform cell; the error is its square

/// A formula may divide by zero on its way to a value that is then looked at: no traps meanwhile.
class QuietFloats {
public:
    QuietFloats() { std::feholdexcept(&before_); }
    ~QuietFloats() { std::fesetenv(&before_); }
    QuietFloats(const QuietFloats&) = delete;
    QuietFloats& operator=(const QuietFloats&) = delete;

private:
    std::fenv_t before_{};
};

[[noreturn]] void fail_at(std::size_t column, std::string message, std::string hint = {}) {
    Diagnostic found;
    found.place.column = static_cast<int>(column);
    found.message = "Weight expression: " + std::move(message);
    found.hint = std::move(hint);
    throw Error(std::move(found));
}

constexpr const char* known_names = "The variables are u, v, x and y";

/// muParser's own sentence without its position, which counts from 0.
std::string sentence(const mu::Parser::exception_type& fault) {
    static const std::regex position(R"(( found)?( at position \d+)\.?)");
    return std::regex_replace(fault.GetMsg(), position, "");
}

[[noreturn]] void fail(const mu::Parser::exception_type& fault) {
    const int position = std::max(0, fault.GetPos());
    fail_at(static_cast<std::size_t>(position) + 1, sentence(fault), known_names);
}

/// `u = 0.5` is a comparison that lost a sign, not a formula: muParser would assign.
void refuse_assignment(const std::string& text) {
    for (std::size_t k = 0; k < text.size(); ++k) {
        const bool alone = text[k] == '=' &&
                           (k == 0 || std::string("=<>!").find(text[k - 1]) == std::string::npos) &&
                           (k + 1 == text.size() || text[k + 1] != '=');
        if (alone) {
            fail_at(k + 1, "\"=\" assigns", "Compare with ==");
        }
    }
}

/// One parser with its variables, used by one thread.
class Formula {
public:
    Formula(const std::string& text, const Vec2& cells) : cells_(cells) {
        try {
            parser_.DefineVar("x", &x_);
            parser_.DefineVar("y", &y_);
            parser_.DefineVar("u", &u_);
            parser_.DefineVar("v", &v_);
            parser_.DefineConst("pi", pi);
            parser_.SetExpr(text);
        } catch (const mu::Parser::exception_type& fault) {
            fail(fault);
        }
    }
    Formula(const Formula&) = delete; // the parser points into the object
    Formula& operator=(const Formula&) = delete;

    /// Whatever comes out, finite or not.
    double at(const Vec2& p) {
        x_ = p.x();
        y_ = p.y();
        u_ = p.x() / cells_.x();
        v_ = p.y() / cells_.y();
        try {
            int results = 0;
            const double* found = parser_.Eval(results);
            if (results != 1) {
                fail_at(1,
                        "there are " + std::to_string(results) + " values",
                        "Separate terms by operators, not by commas");
            }
            return found[0];
        } catch (const mu::Parser::exception_type& fault) {
            fail(fault);
        }
    }

private:
    mu::Parser parser_;
    Vec2 cells_;
    double x_ = 0.0, y_ = 0.0, u_ = 0.0, v_ = 0.0;
};

class ExpressionWeight final : public Weight {
public:
    ExpressionWeight(std::string text, const Vec2& cells) : text_(std::move(text)), cells_(cells) {}

    void values(std::span<const Vec2> at, std::span<double> w) const override {
        const QuietFloats quiet;
        Formula formula(text_, cells_);
        for (std::size_t k = 0; k < at.size(); ++k) {
            w[k] = finite(formula, at[k]);
        }
    }

    void gradients(std::span<const Vec2> at, std::span<Vec2> gradient) const override {
        const QuietFloats quiet;
        Formula formula(text_, cells_);
        const auto slope = [&](const Vec2& p, const Vec2& h) {
            const Vec2 ahead = p + h;
            const Vec2 back = p - h;
            return (inside(formula, ahead) - inside(formula, back)) / (2.0 * difference_step);
        };
        for (std::size_t k = 0; k < at.size(); ++k) {
            gradient[k] =
                Vec2(slope(at[k], Vec2(difference_step, 0.0)), slope(at[k], Vec2(0.0, difference_step)));
        }
    }

private:
    double finite(Formula& formula, const Vec2& p) const {
        const double w = formula.at(p);
        if (!std::isfinite(w)) {
            fail_at(1,
                    "\"" + text_ + "\" has no finite value at u = " + shortest(p.x() / cells_.x()) +
                        ", v = " + shortest(p.y() / cells_.y()),
                    "A weight is a positive number everywhere on the surface");
        }
        return w;
    }

    /// Off the surface the formula need not make sense: the nearest point of its edge counts.
    double inside(Formula& formula, const Vec2& p) const {
        return finite(formula, p.cwiseMax(Vec2::Zero()).cwiseMin(cells_));
    }

    std::string text_;
    Vec2 cells_;
};

} // namespace

WeightPtr expression_weight(const std::string& text, int nu, int nv) {
    expects(nu >= 2 && nv >= 2, "a grid has at least 2 x 2 nodes");
    if (text.size() > longest_expression) {
        fail_at(longest_expression,
                "it is longer than " + std::to_string(longest_expression) + " characters");
    }
    refuse_assignment(text);
    const auto weight = std::make_shared<ExpressionWeight>(text, Vec2(nu - 1, nv - 1));
    NodeArray nodes = Grid::uniform(nu, nv).array();
    for (Vec2& p : nodes.nodes) {
        p = p.cwiseProduct(Vec2(nu - 1, nv - 1)).eval();
    }
    std::vector<double> w(nodes.nodes.size());
    weight->values(nodes.nodes, w);
    return weight;
}

} // namespace millwright::grid
