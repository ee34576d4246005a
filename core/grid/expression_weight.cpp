#include "core/grid/expression_weight.h"

#include "core/base/error.h"
#include "core/base/quiet_floats.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/geometry/surface_point.h"
#include "core/grid/grid.h"

#include <muParser.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <regex>
#include <utility>

namespace millwright::grid {

namespace {

constexpr std::size_t longest_expression = 500;
constexpr double difference_step = 1e-5; // of a uniform cell; the error is its square

[[noreturn]] void fail_at(std::size_t column, std::string message, std::string hint = {}) {
    Diagnostic found;
    found.place.column = static_cast<int>(column);
    found.message = "Weight expression: " + std::move(message);
    found.hint = std::move(hint);
    throw Error(std::move(found));
}

constexpr const char* known_names = "Use the variables u, v, i, j, x, y, z, nx, ny, nz, k1, k2 and err";

/// muParser's own sentence without its position, which counts from 0.
std::string sentence(const mu::Parser::exception_type& fault) {
    static const std::regex position(R"(( found)?( at position \d+)\.?)");
    return std::regex_replace(fault.GetMsg(), position, "");
}

[[noreturn]] void fail_in_formula(const mu::Parser::exception_type& fault) {
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
            fail_at(k + 1, "\"=\" is an assignment", "Use == to compare");
        }
    }
}

/// The values of the variables at one place.
struct Variables {
    double u = 0.5, v = 0.5, i = 1.0, j = 1.0;
    double x = 1.0, y = 1.0, z = 1.0, nx = 0.0, ny = 0.0, nz = 1.0, k1 = 1.0, k2 = 1.0;
    double err = 1.0;
};

struct NamedVariable {
    const char* name;
    double Variables::*value;
};
constexpr std::array<NamedVariable, 4> of_parameters{
    {{"u", &Variables::u}, {"v", &Variables::v}, {"i", &Variables::i}, {"j", &Variables::j}}};
constexpr std::array<NamedVariable, 8> of_surface{{{"x", &Variables::x},
                                                   {"y", &Variables::y},
                                                   {"z", &Variables::z},
                                                   {"nx", &Variables::nx},
                                                   {"ny", &Variables::ny},
                                                   {"nz", &Variables::nz},
                                                   {"k1", &Variables::k1},
                                                   {"k2", &Variables::k2}}};
constexpr NamedVariable of_error{"err", &Variables::err};

/// One parser with its variables, used by one thread.
class Formula {
public:
    explicit Formula(const std::string& text) {
        try {
            for (const NamedVariable& each : of_parameters) {
                parser_.DefineVar(each.name, &(now_.*each.value));
            }
            for (const NamedVariable& each : of_surface) {
                parser_.DefineVar(each.name, &(now_.*each.value));
            }
            parser_.DefineVar(of_error.name, &(now_.*of_error.value));
            parser_.DefineConst("pi", pi);
            parser_.SetExpr(text);
            mu::Parser asked(parser_); // the question makes a parser forget what it does not know
            const mu::varmap_type used = asked.GetUsedVar();
            uses_surface_ = std::ranges::any_of(
                of_surface, [&](const NamedVariable& each) { return used.count(each.name) > 0; });
            uses_error_ = used.count(of_error.name) > 0;
        } catch (const mu::Parser::exception_type& fault) {
            fail_in_formula(fault);
        }
    }
    Formula(const Formula&) = delete; // the parser points into the object
    Formula& operator=(const Formula&) = delete;

    [[nodiscard]] bool uses_surface() const { return uses_surface_; }
    [[nodiscard]] bool uses_error() const { return uses_error_; }

    /// Whatever comes out, finite or not.
    double at(const Variables& values) {
        now_ = values;
        try {
            int results = 0;
            const double* found = parser_.Eval(results);
            if (results != 1) {
                fail_at(1,
                        "the formula has " + std::to_string(results) + " values",
                        "Combine terms with operators, not with commas");
            }
            return found[0];
        } catch (const mu::Parser::exception_type& fault) {
            fail_in_formula(fault);
        }
    }

private:
    mu::Parser parser_;
    Variables now_;
    bool uses_surface_ = false;
    bool uses_error_ = false;
};

/// What the variables are on one grid.
class Ground {
public:
    Ground(FormulaGround ground, const Vec2& cells) : ground_(std::move(ground)), cells_(cells) {}

    [[nodiscard]] const Vec2& cells() const { return cells_; }

    /// Refuses a formula that speaks of what is not at hand.
    void expect(const Formula& formula) const {
        if (formula.uses_surface() && ground_.patch == nullptr) {
            fail_at(1, "it uses a surface, but there is none");
        }
        if (formula.uses_error() && ground_.error == nullptr) {
            fail_at(1, "it uses the error, which has not been measured");
        }
    }

    [[nodiscard]] Variables at(const Vec2& p, const Formula& formula) const {
        Variables found;
        found.i = p.x();
        found.j = p.y();
        found.u = p.x() / cells_.x();
        found.v = p.y() / cells_.y();
        if (formula.uses_surface()) {
            add_surface(found);
        }
        if (formula.uses_error()) {
            ground_.error->values({&p, 1}, {&found.err, 1});
        }
        return found;
    }

private:
    void add_surface(Variables& found) const {
        const geometry::SurfaceDerivatives at = ground_.patch->derivatives(found.u, found.v);
        found.x = at.position.x();
        found.y = at.position.y();
        found.z = at.position.z();
        const double none = std::numeric_limits<double>::quiet_NaN(); // refused if the formula needs it
        const Vec3 normal = ground_.patch->unit_normal(found.u, found.v).value_or(Vec3(none, none, none));
        found.nx = normal.x();
        found.ny = normal.y();
        found.nz = normal.z();
        const auto bent = geometry::principal_curvatures(at);
        found.k1 = bent ? bent->k1 : none;
        found.k2 = bent ? bent->k2 : none;
    }

    FormulaGround ground_;
    Vec2 cells_;
};

class ExpressionWeight final : public Weight {
public:
    ExpressionWeight(std::string text, Ground ground) : text_(std::move(text)), ground_(std::move(ground)) {}

    void values(std::span<const Vec2> at, std::span<double> w) const override {
        const QuietFloats quiet;
        Formula formula(text_);
        for (std::size_t k = 0; k < at.size(); ++k) {
            w[k] = finite(formula, at[k]);
        }
    }

    void gradients(std::span<const Vec2> at, std::span<Vec2> gradient) const override {
        const QuietFloats quiet;
        Formula formula(text_);
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
        const double w = formula.at(ground_.at(p, formula));
        if (!std::isfinite(w)) {
            fail_at(1,
                    "\"" + text_ + "\" has no finite value at u = " + shortest(p.x() / ground_.cells().x()) +
                        ", v = " + shortest(p.y() / ground_.cells().y()),
                    "Use a weight that is positive everywhere on the surface");
        }
        return w;
    }

    /// Off the surface the formula need not make sense: the nearest point of its edge counts.
    double inside(Formula& formula, const Vec2& p) const {
        return finite(formula, p.cwiseMax(Vec2::Zero()).cwiseMin(ground_.cells()));
    }

    std::string text_;
    Ground ground_;
};

void refuse_what_is_no_formula(const std::string& text) {
    if (text.size() > longest_expression) {
        fail_at(longest_expression,
                "it is longer than " + std::to_string(longest_expression) + " characters");
    }
    refuse_assignment(text);
}

} // namespace

WeightPtr expression_weight(const std::string& text, int nu, int nv, const FormulaGround& ground) {
    expects(nu >= 2 && nv >= 2, "a grid has at least 2 x 2 nodes");
    refuse_what_is_no_formula(text);
    const Vec2 cells(nu - 1, nv - 1);
    const Ground here(ground, cells);
    here.expect(Formula(text));
    const auto weight = std::make_shared<ExpressionWeight>(text, here);
    NodeArray nodes = Grid::uniform(nu, nv).array();
    for (Vec2& p : nodes.nodes) {
        p = p.cwiseProduct(cells).eval();
    }
    std::vector<double> w(nodes.nodes.size());
    weight->values(nodes.nodes, w);
    return weight;
}

std::optional<Diagnostic> fault_of_expression(const std::string& text) {
    try {
        refuse_what_is_no_formula(text);
        const QuietFloats quiet;
        Formula(text).at({});
        return std::nullopt;
    } catch (const Error& error) {
        return error.diagnostic();
    }
}

bool speaks_of_error(const std::string& text) {
    return !fault_of_expression(text) && Formula(text).uses_error();
}

} // namespace millwright::grid
