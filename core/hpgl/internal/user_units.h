// From the coordinates that a file counts in to plotter units: scaling points, scaling, rotation (IP, IR, SC,
// RO).
#pragma once

#include "core/hpgl/hpgl_settings.h"

#include <array>
#include <optional>

namespace millwright::hpgl::internal {

class UserUnits {
public:
    explicit UserUnits(const HpglSettings& settings);

    [[nodiscard]] Vec2 plotter(const Vec2& user) const { return linear_ * user + offset_; }
    [[nodiscard]] Vec2 plotter_step(const Vec2& user) const { return linear_ * user; }
    [[nodiscard]] Vec2 user(const Vec2& plotter) const { return inverse_ * (plotter - offset_); }
    /// Unscaled, only turned as RO says: for characters, whose size is in centimetres.
    [[nodiscard]] Vec2 turned(const Vec2& step) const { return turn_ * step; }

    [[nodiscard]] Vec2 p1() const { return p1_; }
    [[nodiscard]] Vec2 p2() const { return p2_; }
    [[nodiscard]] Vec2 span() const { return p2_ - p1_; }
    [[nodiscard]] bool scaled() const { return scaling_.has_value(); }

    /// What the commands set; false where that is no coordinate system, and then nothing changes.
    void reset_points();
    bool set_points(const Vec2& p1, const Vec2& p2);
    bool set_relative_points(const Vec2& percent_1, const Vec2& percent_2);
    void no_scale();
    bool scale_to_fit(const Vec2& at_p1, const Vec2& at_p2);
    /// The same scale on both axes; what is left over goes by percent to the left and below.
    bool scale_isotropic(const Vec2& at_p1, const Vec2& at_p2, const Vec2& rest_percent);
    bool scale_by_factor(const Vec2& at_p1, const Vec2& factor);
    bool rotate(int degrees);

private:
    enum class Fit { both, isotropic, factor };
    struct Scaling {
        Fit fit = Fit::both;
        Vec2 at_p1 = Vec2::Zero();
        Vec2 at_p2 = Vec2::Zero(); ///< of a factor: the factor
        Vec2 rest_percent = Vec2(50.0, 50.0);
    };
    bool derive(const Vec2& p1, const Vec2& p2, const std::optional<Scaling>& scaling);

    Vec2 sheet_1_;
    Vec2 sheet_2_;
    Vec2 p1_;
    Vec2 p2_;
    std::optional<Scaling> scaling_;
    Eigen::Matrix2d turn_ = Eigen::Matrix2d::Identity();
    Eigen::Matrix2d linear_ = Eigen::Matrix2d::Identity();
    Eigen::Matrix2d inverse_ = Eigen::Matrix2d::Identity();
    Vec2 offset_ = Vec2::Zero();
};

} // namespace millwright::hpgl::internal
