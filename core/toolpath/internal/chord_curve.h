// The surface curve under a move as a chain of chords, made for one question that is asked a thousand million
// times: which of its points is nearest? Sixteen chords are looked at together.
#pragma once

#include "core/geometry/vectors.h"

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace millwright::toolpath {

class ChordCurve {
public:
    /// Two points or more, each with the surface normal there.
    ChordCurve(std::vector<Vec3> points, std::vector<Vec3> normals);

    struct Nearest {
        double squared = std::numeric_limits<double>::infinity(); ///< distance, mm^2
        Vec3 point = Vec3::Zero();
        Vec3 normal = Vec3::UnitZ(); ///< between those of the chord's ends; not scaled
        std::size_t chord = 0;       ///< on which it is
        double fraction = 0.0;       ///< of that chord, 0 to 1
    };
    /// On the first of the chords that are equally near.
    [[nodiscard]] Nearest nearest(const Vec3& p) const;

    /// Not below nearest(p).squared but for rounding, and mostly just that: from `chord` along the curve as
    /// long as it comes nearer.
    [[nodiscard]] double squared_beside(const Vec3& p, std::size_t chord) const;

    /// At fraction `t` of the curve's parameters, 0 to 1.
    [[nodiscard]] Vec3 at(double t) const;
    [[nodiscard]] double length() const;

private:
    static constexpr std::ptrdiff_t lanes = 16;
    using Lanes = Eigen::Array<double, lanes, 1>;
    /// Chords from `start` over `span`; those that fill the last pack up are points at the curve's end.
    struct Pack {
        std::array<Lanes, 3> start;
        std::array<Lanes, 3> span;
        Lanes inverse_square; // of the span's length; 0 of a point
        Vec3 middle;          // of a ball around all of them
        double radius = 0.0;  // of it, mm

        /// Not above the distance of its chords from `p`, squared.
        [[nodiscard]] double squared_at_least(const Vec3& p) const;
    };
    void look_in(std::size_t pack, const Vec3& p, double& least, std::size_t& chord) const;
    [[nodiscard]] Nearest on_chord(std::size_t chord, const Vec3& p) const;

    std::vector<Vec3> points_;
    std::vector<Vec3> normals_;
    std::vector<Pack> packs_;
};

} // namespace millwright::toolpath
