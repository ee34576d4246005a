// A machine's error in closed form: smooth curvature everywhere and a spike near one point that saturates, as
// a pole of the rotary axes makes it. Lets the grid room be tested without any machine.
#pragma once

#include "core/base/numbers.h"
#include "tests/support/closed_form_error_model.h"

#include <algorithm>
#include <cmath>

namespace millwright::grid {

class SpikeErrorModel final : public ClosedFormErrorModel {
public:
    struct Shape {
        Vec2 spike{0.48, 0.52};
        double background = 20.0; ///< error of a move of length h far from the spike: background h^2
        double height = 4000.0;   ///< more of that at the spike
        double width = 0.06;      ///< of the spike, in parameters
        double limit = 10.0;      ///< no move is worse
    };

    explicit SpikeErrorModel(Shape shape) : shape_(shape) {}

    [[nodiscard]] MoveError move(const Vec2& a, const Vec2& b, Sampling) const override {
        const double h = (b - a).norm();
        const double away = nearest_on_move(a, b);
        const double kappa = shape_.background + shape_.height / (1.0 + square(away / shape_.width));
        const double e = kappa * h * h;
        const double tip = shape_.limit * e / (shape_.limit + e);
        return {tip, tip / 100.0, size * h};
    }

private:
    /// The distance of the spike from the nearest point of the move.
    [[nodiscard]] double nearest_on_move(const Vec2& a, const Vec2& b) const {
        const Vec2 along = b - a;
        const Vec2 to_spike = shape_.spike - a;
        const double length2 = along.squaredNorm();
        const double t = length2 > 0.0 ? std::clamp(to_spike.dot(along) / length2, 0.0, 1.0) : 0.0;
        const Vec2 nearest = a + t * along;
        return (nearest - shape_.spike).norm();
    }

    Shape shape_;
};

} // namespace millwright::grid
