// What the closed-form error models of the tests share: a lattice that asks the model itself, and a plane
// part of 100 mm.
#pragma once

#include "core/grid/error_model.h"

#include <algorithm>
#include <memory>
#include <span>
#include <vector>

namespace millwright::grid {

class ClosedFormErrorModel : public ErrorModel {
public:
    [[nodiscard]] std::unique_ptr<LatticeErrors> lattice(std::span<const Vec2> nodes,
                                                         Sampling sampling) const override {
        return std::make_unique<Lattice>(*this, nodes, sampling);
    }

    [[nodiscard]] double track_gap(const Grid& grid, TrackDirection direction) const override {
        double gap = 0.0;
        for (int t = 0; t + 1 < grid.track_count(direction); ++t) {
            for (int k = 0; k < grid.nodes_per_track(direction); ++k) {
                const Vec2 step = grid.track_node(direction, t + 1, k) - grid.track_node(direction, t, k);
                gap = std::max(gap, size * step.norm());
            }
        }
        return gap;
    }

protected:
    static constexpr double size = 100.0; ///< of the part, mm a unit of the parameters

private:
    class Lattice final : public LatticeErrors {
    public:
        Lattice(const ErrorModel& model, std::span<const Vec2> nodes, Sampling sampling)
            : model_(model), nodes_(nodes.begin(), nodes.end()), sampling_(sampling) {}
        [[nodiscard]] MoveError between(int k, int l) const override {
            return model_.move(
                nodes_[static_cast<std::size_t>(k)], nodes_[static_cast<std::size_t>(l)], sampling_);
        }

    private:
        const ErrorModel& model_;
        std::vector<Vec2> nodes_;
        Sampling sampling_;
    };
};

} // namespace millwright::grid
