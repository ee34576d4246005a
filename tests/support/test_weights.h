// Weights that no person would ask for.
#pragma once

#include "core/grid/weight.h"

#include <algorithm>
#include <memory>

namespace millwright::grid {

/// `value` at every point, whatever it is.
[[nodiscard]] inline WeightPtr broken_weight(double value) {
    class Broken final : public Weight {
    public:
        explicit Broken(double everywhere) : value_(everywhere) {}
        void values(std::span<const Vec2>, std::span<double> w) const override {
            std::ranges::fill(w, value_);
        }
        void gradients(std::span<const Vec2>, std::span<Vec2> gradient) const override {
            std::ranges::fill(gradient, Vec2(Vec2::Zero()));
        }

    private:
        double value_;
    };
    return std::make_shared<Broken>(value);
}

} // namespace millwright::grid
