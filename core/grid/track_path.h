// The best nodes of one track, exactly: with the error of a move depending on its two nodes alone, the best
// choice of n nodes among the places of a lattice is a path of n - 1 moves through a graph, found by dynamic
// programming. It jumps over singular points of the machine where the tip survives it, which no descent from
// a given grid finds.
#pragma once

#include "core/base/numbers.h"
#include "core/base/progress.h"
#include "core/grid/error_model.h"
#include "core/grid/track.h"

#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace millwright::grid {

// What a move costs the track optimiser, and what no move may exceed.

/// error = off_surface + tip_share (tip - off_surface) + param_share param + axis_weight axis
/// cost = (even_length + length_share (length - even_length)) error^exponent
/// By the mean per move (length_share 0) the search buys many tiny perfect moves with a few long bad ones; by
/// the length (length_share 1) it neglects what the mean counts. In between it serves both means.
struct MoveCost {
    double exponent = 2.0;
    double tip_share = 1.0;
    double param_share = 0.0;
    double axis_weight = 0.0; ///< mm that one rad of axis deviation counts
    double length_share = 1.0;
    double even_length = 1.0; ///< of a move if all moves of the track were equally long, mm

    /// Infinity where the move is out of reach.
    [[nodiscard]] double operator()(const MoveError& move) const {
        if (!std::isfinite(move.tip) || !std::isfinite(move.axis)) {
            return std::numeric_limits<double>::infinity();
        }
        const double error =
            mix(move.off_surface, move.tip, tip_share) + param_share * move.param + axis_weight * move.axis;
        const double weight = mix(even_length, move.length, length_share);
        return weight * (exactly_equal(exponent, 2.0) ? square(error) : std::pow(error, exponent));
    }
};

struct MoveLimits {
    double tip = std::numeric_limits<double>::infinity();  ///< mm
    double axis = std::numeric_limits<double>::infinity(); ///< rad

    [[nodiscard]] bool allow(const MoveError& move) const { return move.tip <= tip && move.axis <= axis; }
};

/// Which moves of a lattice are looked at: those whose places differ by `shortest` to `longest`.
struct MoveWindow {
    double shortest = 0.0;
    double longest = 1.0;
};

/// Whether the move from place k to place l > k of a lattice is to be measured.
using MoveFilter = std::function<bool(int k, int l)>;

/// The errors of all moves of a lattice inside a window, one row per place.
class MoveTable {
public:
    /// `places` ascend. Measures every move that `filter` accepts once; the others count as out of reach.
    /// Without a filter every move is measured. Throws Cancelled within one row.
    MoveTable(const ErrorModel& model,
              const Track& track,
              std::vector<double> places,
              MoveWindow window,
              Sampling sampling,
              const Progress& progress,
              const MoveFilter& filter = {});

    [[nodiscard]] const std::vector<double>& places() const { return places_; }
    [[nodiscard]] int size() const { return static_cast<int>(std::ssize(places_)); }
    /// The moves from place k go to the places l with first(k) <= l < end(k).
    [[nodiscard]] int first(int k) const { return rows_[static_cast<std::size_t>(k)].first; }
    [[nodiscard]] int end(int k) const { return rows_[static_cast<std::size_t>(k)].end; }
    [[nodiscard]] const MoveError& move(int k, int l) const;
    /// Puts a better measurement in the place of that of a move inside the window.
    void replace(int k, int l, const MoveError& error);
    /// The position of `place`, which is one of places().
    [[nodiscard]] int index_of(double place) const;

private:
    struct Row {
        int first = 0;
        int end = 0;
        std::size_t offset = 0; // of the row's first move in moves_
    };

    std::vector<double> places_;
    std::vector<Row> rows_;
    std::vector<MoveError> moves_;
};

/// A path from the first place to the last.
struct LatticePath {
    std::vector<int> nodes;
    double value = 0.0; ///< the sum of costs, or the largest quantity
};

/// The path of exactly `moves` moves inside `limits` with the least sum of costs. Nothing if there is none
/// of finite cost.
[[nodiscard]] std::optional<LatticePath>
cheapest_path(const MoveTable& table, int moves, const MoveCost& cost, const MoveLimits& limits);

/// The path of exactly `moves` moves inside `limits` whose largest `quantity` (&MoveError::tip, say) is
/// least.
[[nodiscard]] std::optional<LatticePath>
least_worst_path(const MoveTable& table, int moves, double MoveError::*quantity, const MoveLimits& limits);

/// The path of the fewest moves inside `limits`, of several the one with the least sum of costs. Nothing if
/// no path is inside.
[[nodiscard]] std::optional<LatticePath>
shortest_path(const MoveTable& table, const MoveCost& cost, const MoveLimits& limits);

/// The places of `path`.
[[nodiscard]] std::vector<double> places_of(const MoveTable& table, const LatticePath& path);

// The last few per cent between the places of the lattice: each node in turn tries a step forward and back on
// its track and stays where the cost of its two moves is less. Steps grow where they succeed and shrink where
// not.

struct PolishSettings {
    MoveCost cost = {};
    MoveLimits limits = {};
    double min_gap = 0.0;      ///< no two nodes come nearer, or nearer than they are
    Sampling sampling{16, 16}; ///< 10 times inside a move let the search slip between them
    double first_step = 0.10;  ///< of the smaller gap next to the node
    double growth = 1.3;       ///< of the step after a success
    double shrinking = 0.5;    ///< of the step after a failure both ways
};

/// One track while it is polished. The ends stay, the total cost never rises, and of the two moves at a node
/// the worse one, where it is above a limit, never gets worse in what it exceeds.
class TrackPolish {
public:
    TrackPolish(const ErrorModel& model, PlacedTrack track, const PolishSettings& settings);

    /// Moves every inner node once; returns the longest way that one went. Throws Cancelled with the track
    /// valid but half swept.
    double sweep(const Progress& progress);

    [[nodiscard]] const PlacedTrack& track() const { return track_; }
    /// By the settings' sampling.
    [[nodiscard]] const std::vector<MoveError>& moves() const { return moves_; }

private:
    [[nodiscard]] MoveError move(double from, double to) const;
    bool try_place(std::size_t node, double place);

    const ErrorModel& model_;
    PolishSettings settings_;
    PlacedTrack track_;
    std::vector<MoveError> moves_; // [node]: from this node to the next
    std::vector<double> steps_;    // [node]
};

} // namespace millwright::grid
