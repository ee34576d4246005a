// Line types: which parts of a vector are drawn (LT, UL). Lengths in plotter units.
#pragma once

#include "core/geometry/vectors.h"

#include <array>
#include <functional>
#include <optional>
#include <vector>

namespace millwright::hpgl::internal {

/// Percents of the pattern's length: drawn, left out, drawn, ... A drawn part of 0 is a dot.
using Pattern = std::vector<double>;

/// The patterns 1 to 8 that a plotter has after IN (HP-GL/2 reference guide, UL). [0] is that of type 1.
[[nodiscard]] const std::array<Pattern, 8>& initial_patterns();

class LineType {
public:
    /// Whole vectors.
    void set_solid();
    /// Dots at the ends of vectors and nothing between.
    void set_dots();
    /// `pattern` again and again, going on from vector to vector until the pen is lifted.
    void set_pattern(const Pattern& pattern, double length);
    /// The pattern a whole number of times a vector, beginning and ending in the middle of its first part.
    void set_adaptive(const Pattern& pattern, double length);

    [[nodiscard]] bool solid() const { return kind_ == Kind::solid; }
    /// The pen was lifted: the pattern begins anew.
    void restart() { phase_ = 0.0; }

    /// Calls `draw(a, b)` for each part of the vector that is drawn; a dot has a = b. Stops when it returns
    /// false.
    void apply(const Vec2& from, const Vec2& to, const std::function<void(const Vec2&, const Vec2&)>& draw);

private:
    enum class Kind { solid, dots, pattern, adaptive };
    Kind kind_ = Kind::solid;
    Pattern pattern_; ///< fractions of the length
    double length_ = 0.0;
    double phase_ = 0.0; ///< how far into the pattern the next vector begins, in plotter units
};

} // namespace millwright::hpgl::internal
