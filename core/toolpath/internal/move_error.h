// The error of one move whose axis positions are known.
#pragma once

#include "core/grid/error_model.h"
#include "core/kinematics/machine_model.h"
#include "core/toolpath/internal/chord_curve.h"

#include <functional>
#include <vector>

namespace millwright::toolpath {

// Where inside a move the true pose is looked at so that none of its largest deviations is missed: a branch
// and bound on the time, which halves every stretch that can still hide more than was seen.

/// What is off at one time of a move.
struct Look {
    double t = 0.0;
    double closest = 0.0; ///< mm
    double param = 0.0;   ///< mm
    double axis = 0.0;    ///< rad
};

/// How much a deviation can rise inside a stretch of the length h in t above its ends: h^2 / 8 times these.
struct LookBend {
    double closest = 0.0; ///< mm
    double param = 0.0;   ///< mm
    double axis = 0.0;    ///< rad
};

/// How exactly the largest `closest` of a move is to be known: a thousandth of it, and from 0.1 to 1 um.
[[nodiscard]] double closest_tolerance(double largest);
/// The same of `param`: a hundredth, and from 1 to 10 um.
[[nodiscard]] double param_tolerance(double largest);
/// The same of `axis`: a thousandth of a degree.
[[nodiscard]] double axis_tolerance();

/// In order of time, from `begin` to `end` (t = 0 and 1), at first at `parts` equal stretches. A stretch is
/// halved while the bend, or half the steepest slope in it and its neighbours (for deviations that have a
/// kink), allows a value in it that is above the largest seen by more than the tolerance.
[[nodiscard]] std::vector<Look> looks_until_known(const Look& begin,
                                                  const Look& end,
                                                  int parts,
                                                  const LookBend& bend,
                                                  const std::function<Look(double)>& look_at);

/// The axes go linearly from `from` to `to`; the tip should follow `curve` and the tool axis its normals.
/// `tip_samples` times inside the move.
[[nodiscard]] grid::MoveError move_error(const kinematics::MachineModel& machine,
                                         const kinematics::AxisPositions& from,
                                         const kinematics::AxisPositions& to,
                                         const ChordCurve& curve,
                                         int tip_samples);

} // namespace millwright::toolpath
