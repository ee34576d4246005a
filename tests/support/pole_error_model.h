// The error that a pole of the rotary axes makes, in closed form: the turning angle is the direction from the
// pole, the nearer of two branches (half a turn apart) is taken, and the tip leaves the surface by R (1 -
// cos(turn / 2)).
#pragma once

#include "core/base/numbers.h"
#include "core/base/units.h"
#include "core/grid/error_model.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

namespace millwright::grid {

class PoleErrorModel final : public ErrorModel {
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
                100.0 * h};
    }

    [[nodiscard]] std::unique_ptr<LatticeErrors> lattice(std::span<const Vec2> nodes,
                                                         Sampling sampling) const override {
        return std::make_unique<Lattice>(*this, nodes, sampling);
    }

    [[nodiscard]] double track_gap(const Grid& grid, TrackDirection direction) const override {
        double gap = 0.0;
        for (int t = 0; t + 1 < grid.track_count(direction); ++t) {
            for (int k = 0; k < grid.nodes_per_track(direction); ++k) {
                const Vec2 step = grid.track_node(direction, t + 1, k) - grid.track_node(direction, t, k);
                gap = std::max(gap, 100.0 * step.norm());
            }
        }
        return gap;
    }

private:
    class Lattice final : public LatticeErrors {
    public:
        Lattice(const PoleErrorModel& model, std::span<const Vec2> nodes, Sampling sampling)
            : model_(model), nodes_(nodes.begin(), nodes.end()), sampling_(sampling) {}
        [[nodiscard]] MoveError between(int k, int l) const override {
            return model_.move(
                nodes_[static_cast<std::size_t>(k)], nodes_[static_cast<std::size_t>(l)], sampling_);
        }

    private:
        const PoleErrorModel& model_;
        std::vector<Vec2> nodes_;
        Sampling sampling_;
    };

    [[nodiscard]] double direction_of(const Vec2& p) const {
        const Vec2 from_pole = p - shape_.pole;
        return std::atan2(from_pole.y(), from_pole.x());
    }

    Shape shape_;
};

} // namespace millwright::grid
