#include "core/grid/weight.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/base/units.h"
#include "core/grid/internal/parallel_nodes.h"

#include <algorithm>
#include <cmath>

namespace millwright::grid {

namespace {

/// A weight given by two functions of one point.
template <class Value, class Gradient> class PointwiseWeight final : public Weight {
public:
    PointwiseWeight(Value value, Gradient gradient) : value_(value), gradient_(gradient) {}

    void values(std::span<const Vec2> at, std::span<double> w) const override {
        std::ranges::transform(at, w.begin(), value_);
    }
    void gradients(std::span<const Vec2> at, std::span<Vec2> gradient) const override {
        std::ranges::transform(at, gradient.begin(), gradient_);
    }

private:
    Value value_;
    Gradient gradient_;
};

template <class Value, class Gradient> WeightPtr formula(Value value, Gradient gradient) {
    return std::make_shared<PointwiseWeight<Value, Gradient>>(value, gradient);
}

} // namespace

WeightPtr constant_weight(double value) {
    return formula([value](const Vec2&) { return value; }, [](const Vec2&) -> Vec2 { return Vec2::Zero(); });
}

WeightPtr ring_weight(const Ring& ring) {
    const auto value = [ring](const Vec2& p) {
        return std::exp(-std::abs(ring.radius_squared - (p - ring.centre).squaredNorm())) + 0.01;
    };
    const auto gradient = [ring](const Vec2& p) -> Vec2 {
        const double inside = ring.radius_squared - (p - ring.centre).squaredNorm();
        const double falls = inside < 0.0 ? 1.0 : -1.0;
        return -2.0 * falls * std::exp(-std::abs(inside)) * (p - ring.centre);
    };
    return formula(value, gradient);
}

WeightPtr weight_w1() {
    return ring_weight({});
}

WeightPtr weight_w1_on(int side) {
    expects(side >= 2, "a grid has at least 2 x 2 nodes");
    const double scale = 24.0 / (side - 1);
    const WeightPtr w1 = weight_w1();
    const auto value = [w1, scale](const Vec2& p) {
        const Vec2 at = scale * p;
        double w = 0.0;
        w1->values({&at, 1}, {&w, 1});
        return w;
    };
    const auto gradient = [w1, scale](const Vec2& p) -> Vec2 {
        const Vec2 at = scale * p;
        Vec2 found = Vec2::Zero();
        w1->gradients({&at, 1}, {&found, 1});
        return scale * found;
    };
    return formula(value, gradient);
}

WeightPtr weight_w2(int rows) {
    return ring_weight({.centre = {10.0, 10.0}, .radius_squared = 1.0 * rows});
}

WeightPtr weight_w3(int rows, int columns) {
    return ring_weight({.centre = Vec2(rows, columns), .radius_squared = 25.0});
}

WeightPtr weight_w4() {
    constexpr double k = 2.0 * pi / 25.0;
    constexpr double amplitude = 1.0 / 1000.0;
    const auto value = [](const Vec2& p) { return amplitude * std::sin(k * p.x()) * std::sin(k * p.y()); };
    const auto gradient = [](const Vec2& p) -> Vec2 {
        return amplitude * k *
               Vec2(std::cos(k * p.x()) * std::sin(k * p.y()), std::sin(k * p.x()) * std::cos(k * p.y()));
    };
    return formula(value, gradient);
}

WeightPtr weight_w5(double scale) {
    expects(scale > 0.0, "the scale of a weight is positive");
    const auto value = [scale](const Vec2& p) { return std::exp((p / scale).squaredNorm()); };
    const auto gradient = [scale, value](const Vec2& p) -> Vec2 {
        return 2.0 * value(p) / square(scale) * p;
    };
    return formula(value, gradient);
}

std::vector<double> weight_at_nodes(const Weight& weight, const NodeArray& nodes) {
    std::vector<double> w(nodes.nodes.size());
    for_pieces(w.size(), [&](std::size_t first, std::size_t count) {
        weight.values(std::span(nodes.nodes).subspan(first, count), std::span(w).subspan(first, count));
    });
    return w;
}

int count_not_positive(const Weight& weight, const NodeArray& nodes) {
    const std::vector<double> w = weight_at_nodes(weight, nodes);
    return static_cast<int>(std::ranges::count_if(w, [](double value) { return !(value > 0.0); }));
}

} // namespace millwright::grid
