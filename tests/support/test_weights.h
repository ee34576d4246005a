// Weights for tests of solvers.
#pragma once

#include "core/grid/weight.h"

#include <cmath>
#include <functional>
#include <memory>
#include <utility>

namespace millwright::grid {

struct WeightAndSlope {
    double w = 0.0;
    Vec2 slope = Vec2::Zero();
};

/// The weight that `formula` is.
[[nodiscard]] inline WeightPtr weight_from(std::function<WeightAndSlope(const Vec2&)> formula) {
    class Formula final : public Weight {
    public:
        explicit Formula(std::function<WeightAndSlope(const Vec2&)> at) : at_(std::move(at)) {}
        void values(std::span<const Vec2> at, std::span<double> w) const override {
            for (std::size_t k = 0; k < at.size(); ++k) {
                w[k] = at_(at[k]).w;
            }
        }
        void gradients(std::span<const Vec2> at, std::span<Vec2> gradient) const override {
            for (std::size_t k = 0; k < at.size(); ++k) {
                gradient[k] = at_(at[k]).slope;
            }
        }

    private:
        std::function<WeightAndSlope(const Vec2&)> at_;
    };
    return std::make_shared<Formula>(std::move(formula));
}

/// A ring as wide as the grid lets it be smooth: every solver finds the one grid that it asks for.
[[nodiscard]] inline WeightPtr smooth_ring_weight(int rows, int columns) {
    return weight_from([cells = Vec2(rows - 1, columns - 1)](const Vec2& p) {
        constexpr double radius = 0.3;
        constexpr double width = 0.12;
        const Vec2 from_middle = p.cwiseQuotient(cells) - Vec2(0.5, 0.5);
        const double r = from_middle.norm();
        const double off = (r - radius) / width;
        const double w = std::exp(-off * off / 2.0);
        const Vec2 outward = r > 0.0 ? Vec2(from_middle / r) : Vec2(Vec2::Zero());
        return WeightAndSlope{0.01 + w, -w * off / width * outward.cwiseQuotient(cells)};
    });
}

/// `value` at every point, whatever it is.
[[nodiscard]] inline WeightPtr broken_weight(double value) {
    return weight_from([value](const Vec2&) { return WeightAndSlope{value, Vec2::Zero()}; });
}

} // namespace millwright::grid
