// The error that a pole of the rotary axes makes, in closed form: the turning angle is the direction from the
// pole, the nearer of two branches (half a turn apart) is taken, and the tip leaves the surface by R (1 -
// cos(turn / 2)).
#pragma once

#include "core/base/numbers.h"
#include "core/base/units.h"
#include "tests/support/closed_form_error_model.h"

#include <cmath>

namespace millwright::grid {

class PoleErrorModel final : public ClosedFormErrorModel {
public:
    struct Shape {
        Vec2 pole{0.48, 0.53};
        double radius = 30.0;    ///< of the part's point at the pole from the turning axis, mm
        double background = 5.0; ///< what a move of length h adds: background h^2
    };

    explicit PoleErrorModel(Shape shape) : shape_(shape) {}

    [[nodiscard]] MoveError move(const Vec2& a, const Vec2& b, Sampling) const override {
        const double h = (b - a).norm();
        const double turn = std::remainder(direction_of(b) - direction_of(a), pi);
        return {shape_.radius * (1.0 - std::cos(turn / 2.0)) + shape_.background * square(h),
                std::abs(turn),
                size * h};
    }

private:
    [[nodiscard]] double direction_of(const Vec2& p) const {
        const Vec2 from_pole = p - shape_.pole;
        return std::atan2(from_pole.y(), from_pole.x());
    }

    Shape shape_;
};

} // namespace millwright::grid
