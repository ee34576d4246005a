// Whether there is material at a place, and how far it is from there, by the lines of a field. To a cell of
// it. Lengths mm.
#pragma once

#include "core/simulation/dexel_field.h"

#include <optional>

namespace millwright::simulation {

/// The end of material that was looked for.
struct MaterialEnd {
    double way = 0.0;                  ///< along the direction
    std::int32_t move = stock_surface; ///< that made it
};

class MaterialProbe {
public:
    /// `field` must outlive it.
    explicit MaterialProbe(const DexelField& field) : field_(field) {}

    /// Whether a line of any family has material within a cell of the place, along each axis.
    [[nodiscard]] bool is_near(const Vec3& place) const;
    /// The first place along the unit `direction` whose nearest lines of any family have material; nullopt:
    /// there is none as far as the box goes.
    [[nodiscard]] std::optional<MaterialEnd> next(const Vec3& place, const Vec3& direction) const;
    /// The nearest material on the lines next to the place, along any axis.
    [[nodiscard]] std::optional<MaterialEnd> nearest_on_lines(const Vec3& place) const;
    /// Along the unit `direction` to where the material around `place` ends, by the line next to it of the
    /// family that is closest to the direction; below 0: so far behind the place it ends. Nullopt: the line
    /// is empty.
    [[nodiscard]] std::optional<MaterialEnd> end(const Vec3& place, const Vec3& direction) const;
    /// How far the place is from where a line along `direction` leaves the box, at least 0.
    [[nodiscard]] double way_out(const Vec3& place, const Vec3& direction) const;

private:
    [[nodiscard]] std::span<const Dexel> line_at(const Vec3& place, int k) const;
    [[nodiscard]] int cell_at(const Vec3& place, int axis) const;

    const DexelField& field_;
};

} // namespace millwright::simulation
