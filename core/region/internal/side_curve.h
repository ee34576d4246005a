// One of the four sides of a face as a curve in space, run through counter-clockwise in the parameters, or a
// line of constant parameter beside it.
#pragma once

#include "core/geometry/bspline_surface.h"
#include "core/geometry/vectors.h"

#include <vector>

namespace millwright::region {

class SideCurve {
public:
    /// The face has to outlive it. `side` as of `place_on_side`; `inset`: from there into the face, by its
    /// parameter.
    SideCurve(const geometry::BsplineSurface& face, int side, double inset = 0.0);

    [[nodiscard]] Vec3 position(double along) const;
    [[nodiscard]] double length() const { return lengths_.back(); } ///< mm
    [[nodiscard]] const Box3& box() const { return box_; }          ///< of its samples
    /// Length from the start, mm, and the way back.
    [[nodiscard]] double length_at(double along) const;
    [[nodiscard]] double along_at(double length) const;

    struct Foot {
        double along = 0.0;
        double distance = 0.0; ///< mm
    };
    /// The nearest of its points from `from` to `to`.
    [[nodiscard]] Foot nearest(const Vec3& point, double from = 0.0, double to = 1.0) const;

private:
    [[nodiscard]] Vec2 place(double along) const;

    const geometry::BsplineSurface* face_;
    int side_;
    double inset_;
    std::vector<Vec3> samples_;
    std::vector<double> lengths_; ///< up to each sample
    Box3 box_;
};

} // namespace millwright::region
