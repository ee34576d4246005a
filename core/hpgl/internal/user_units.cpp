#include "core/hpgl/internal/user_units.h"

#include "core/base/numbers.h"

#include <algorithm>
#include <cmath>

namespace millwright::hpgl::internal {
namespace {

// A scale beyond these would take HPGL's coordinates (2^30) out of what can still be distinguished.
constexpr double smallest_scale = 1e-9;
constexpr double largest_scale = 1e9;

} // namespace

UserUnits::UserUnits(const HpglSettings& settings)
    : sheet_1_(settings.p1), sheet_2_(settings.p2), p1_(settings.p1), p2_(settings.p2) {}

void UserUnits::reset_points() {
    derive(sheet_1_, sheet_2_, scaling_);
}

bool UserUnits::set_points(const Vec2& p1, const Vec2& p2) {
    const bool apart = !exactly_equal(p1.x(), p2.x()) && !exactly_equal(p1.y(), p2.y());
    return apart && derive(p1, p2, scaling_);
}

bool UserUnits::set_relative_points(const Vec2& percent_1, const Vec2& percent_2) {
    const Vec2 sheet = (sheet_2_ - sheet_1_) / 100.0;
    return set_points(sheet_1_ + percent_1.cwiseProduct(sheet), sheet_1_ + percent_2.cwiseProduct(sheet));
}

void UserUnits::no_scale() {
    derive(p1_, p2_, std::nullopt);
}

bool UserUnits::scale_to_fit(const Vec2& at_p1, const Vec2& at_p2) {
    return derive(p1_, p2_, Scaling{.fit = Fit::both, .at_p1 = at_p1, .at_p2 = at_p2});
}

bool UserUnits::scale_isotropic(const Vec2& at_p1, const Vec2& at_p2, const Vec2& rest_percent) {
    return derive(
        p1_,
        p2_,
        Scaling{.fit = Fit::isotropic, .at_p1 = at_p1, .at_p2 = at_p2, .rest_percent = rest_percent});
}

bool UserUnits::scale_by_factor(const Vec2& at_p1, const Vec2& factor) {
    return derive(p1_, p2_, Scaling{.fit = Fit::factor, .at_p1 = at_p1, .at_p2 = factor});
}

bool UserUnits::rotate(int degrees) {
    switch (degrees) {
    case 0:
        turn_ << 1.0, 0.0, 0.0, 1.0;
        break;
    case 90:
        turn_ << 0.0, -1.0, 1.0, 0.0;
        break;
    case 180:
        turn_ << -1.0, 0.0, 0.0, -1.0;
        break;
    case 270:
        turn_ << 0.0, 1.0, -1.0, 0.0;
        break;
    default:
        return false;
    }
    return derive(p1_, p2_, scaling_);
}

bool UserUnits::derive(const Vec2& p1, const Vec2& p2, const std::optional<Scaling>& scaling) {
    Vec2 scale(1.0, 1.0);
    Vec2 offset(0.0, 0.0);
    if (scaling) {
        const Vec2 span = p2 - p1;
        const Vec2 units = scaling->at_p2 - scaling->at_p1;
        if (scaling->fit != Fit::factor && !(units.cwiseAbs().minCoeff() > 0.0)) {
            return false;
        }
        scale = scaling->fit == Fit::factor ? scaling->at_p2 : Vec2(span.cwiseQuotient(units));
        Vec2 rest(0.0, 0.0);
        if (scaling->fit == Fit::isotropic) {
            const double smaller = std::min(std::abs(scale.x()), std::abs(scale.y()));
            scale = Vec2(std::copysign(smaller, scale.x()), std::copysign(smaller, scale.y()));
            rest = (span - scale.cwiseProduct(units)).cwiseProduct(scaling->rest_percent / 100.0);
        }
        offset = p1 + rest - scale.cwiseProduct(scaling->at_p1);
    }
    const auto usable = [](double s) {
        return std::abs(s) >= smallest_scale && std::abs(s) <= largest_scale;
    };
    if (!usable(scale.x()) || !usable(scale.y()) || !is_finite(offset)) {
        return false;
    }
    p1_ = p1;
    p2_ = p2;
    scaling_ = scaling;
    linear_ = turn_ * scale.asDiagonal();
    inverse_ = linear_.inverse();
    offset_ = turn_ * offset;
    return true;
}

} // namespace millwright::hpgl::internal
