// The groove that a cutter leaves along one track, as a tube around its contacts whose radius is that of the
// cutter's outline against the move: how high over a point of the surface it begins. Lengths mm.
#pragma once

#include "core/toolpath/strategy.h"

#include <cstddef>
#include <vector>

namespace millwright::toolpath {

/// A track as a function: the parameter across it at equal steps of the parameter along it, each 0 to 1,
/// straight between them.
using Across = std::vector<double>;

/// The parameters of a place along the tracks and across them.
[[nodiscard]] Vec2 uv_of(grid::TrackDirection direction, double along, double across);

class GrooveTrack {
public:
    /// The contacts are looked at `columns_per_node` times from one node of `nodes` to the next. `forward`:
    /// the tool goes with the parameter along. Throws Error where the surface or the track has no direction.
    GrooveTrack(const Covering& of, const Across& nodes, int columns_per_node, bool forward);

    [[nodiscard]] std::size_t columns() const { return columns_.size(); }
    [[nodiscard]] double along(std::size_t column) const { return columns_[column].along; }
    [[nodiscard]] double across(std::size_t column) const { return columns_[column].across; }
    [[nodiscard]] const Vec3& contact(std::size_t column) const { return columns_[column].contact; }

    /// From `point` to the track, looked for from `column` on.
    [[nodiscard]] double distance(const Vec3& point, std::size_t column) const;

    /// Along the unit `normal` from `point` to the groove; infinity where the cutter does not come.
    [[nodiscard]] double height(const Vec3& point, const Vec3& normal, std::size_t column) const;

    /// The distance across at that column that leaves `height` by the formula of second order.
    [[nodiscard]] double first_step(const Covering& of, std::size_t column, double height) const;

private:
    struct Column {
        double along = 0.0;
        double across = 0.0;
        Vec3 contact = Vec3::Zero();
        Vec3 normal = Vec3::Zero();
        Vec3 before = Vec3::Zero(); ///< the track's derivative by the columns, on the side of the one before
        Vec3 after = Vec3::Zero();  ///< and on that of the next
        double curvature = 0.0;     ///< of the groove across, 1/mm
    };
    /// A place of the groove between two columns.
    struct Spot {
        Vec3 contact = Vec3::Zero();
        Vec3 normal = Vec3::Zero();
        double curvature = 0.0;
    };

    [[nodiscard]] Column
    column_at(const Covering& of, const Across& nodes, std::size_t n, int per_node) const;
    [[nodiscard]] Spot spot(std::size_t column, double t) const;
    [[nodiscard]] Spot nearest(const Vec3& point, std::size_t column) const;

    bool forward_ = true;
    std::vector<Column> columns_;
};

} // namespace millwright::toolpath
