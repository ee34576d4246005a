// Where the lowest point of a tool may go so that its tip leaves every pixel of a height field standing, all
// along straight moves between neighbouring columns. mm.
#pragma once

#include "core/plot/picture/height_field.h"
#include "core/plot/picture/tool_tip.h"

namespace millwright::plot::internal {

/// A pixel q lets the tool come down to f(x) = z_q - rise(|x - q|), which is concave. Over each half of the
/// way from one column to the next f is bounded by a straight line above it (its tangent in the middle, or
/// its highest value), so moves that keep above the bounds at columns and half-way keep above f everywhere.
class TipSurface {
public:
    /// `field` stays where it is.
    TipSurface(const HeightField& field, const ToolTip& tip);

    /// The lowest z over each column at `y`, without going below the field itself, between its rows straight.
    [[nodiscard]] std::vector<float> row(double y) const;

    /// Nowhere between `y_from` and `y_to`, on straight moves over `column`, does any pixel reach higher.
    [[nodiscard]] double highest_between(int column, double y_from, double y_to) const;

private:
    /// What a pixel of height 0 asks at one place between columns.
    struct Bound {
        int shift = 0; ///< column of the pixel, less that of the tool
        int place = 0; ///< of the tool: so many parts of the way to the next column
        float height = 0.0F;
    };

    [[nodiscard]] std::vector<Bound> bounds(double dy) const;
    void raise_to_field(double y, std::vector<float>& nodes) const;

    const HeightField& field_;
    ToolTip tip_;
    int parts_; ///< of the way from column to column, even
    float lowest_ = 0.0F;
    float highest_ = 0.0F;
};

} // namespace millwright::plot::internal
