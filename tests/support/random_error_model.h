// Errors without any sense: a number from 0 to 1 for every pair of nodes, always the same. For searches that
// must find the best of whatever there is, and for promises that must hold whatever comes.
#pragma once

#include "core/grid/error_model.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <vector>

namespace millwright::test {

class RandomErrorModel final : public grid::ErrorModel {
public:
    explicit RandomErrorModel(unsigned seed, bool depends_on_sampling = false)
        : seed_(seed), depends_on_sampling_(depends_on_sampling) {}

    [[nodiscard]] grid::MoveError move(const Vec2& a, const Vec2& b, grid::Sampling sampling) const override {
        const auto salt = static_cast<std::uint64_t>(depends_on_sampling_ ? sampling.tip : 0);
        const double tip = number(a, b, salt + 1000);
        const double off_surface = tip * number(a, b, salt + 2000);
        return {tip, number(a, b, salt + 3000), 100.0 * (b - a).norm(), off_surface, tip};
    }

    [[nodiscard]] std::unique_ptr<grid::LatticeErrors> lattice(std::span<const Vec2> nodes,
                                                               grid::Sampling sampling) const override {
        return std::make_unique<Lattice>(*this, nodes, sampling);
    }

    [[nodiscard]] double track_gap(const grid::Grid& grid, grid::TrackDirection direction) const override {
        double gap = 0.0;
        for (int t = 0; t + 1 < grid.track_count(direction); ++t) {
            for (int k = 0; k < grid.nodes_per_track(direction); ++k) {
                gap = std::max(
                    gap, (grid.track_node(direction, t + 1, k) - grid.track_node(direction, t, k)).norm());
            }
        }
        return gap;
    }

private:
    class Lattice final : public grid::LatticeErrors {
    public:
        Lattice(const RandomErrorModel& model, std::span<const Vec2> nodes, grid::Sampling sampling)
            : model_(model), nodes_(nodes.begin(), nodes.end()), sampling_(sampling) {}
        [[nodiscard]] grid::MoveError between(int k, int l) const override {
            return model_.move(
                nodes_[static_cast<std::size_t>(k)], nodes_[static_cast<std::size_t>(l)], sampling_);
        }

    private:
        const RandomErrorModel& model_;
        std::vector<Vec2> nodes_;
        grid::Sampling sampling_;
    };

    /// 0 to 1, by the finaliser of splitmix64 over the bits of the coordinates.
    [[nodiscard]] double number(const Vec2& a, const Vec2& b, std::uint64_t salt) const {
        std::uint64_t state = seed_ * 7919U + salt;
        for (const double coordinate : {a.x(), a.y(), b.x(), b.y()}) {
            std::uint64_t bits = 0;
            std::memcpy(&bits, &coordinate, sizeof bits);
            state = (state ^ bits) + 0x9e3779b97f4a7c15U;
            state = (state ^ (state >> 30U)) * 0xbf58476d1ce4e5b9U;
            state = (state ^ (state >> 27U)) * 0x94d049bb133111ebU;
            state ^= state >> 31U;
        }
        return static_cast<double>(state >> 11U) * 0x1.0p-53;
    }

    unsigned seed_;
    bool depends_on_sampling_;
};

} // namespace millwright::test
