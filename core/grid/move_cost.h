// What a move costs the track optimiser, and what no move may exceed.
#pragma once

#include "core/base/numbers.h"
#include "core/grid/error_model.h"

#include <cmath>
#include <limits>

namespace millwright::grid {

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

} // namespace millwright::grid
