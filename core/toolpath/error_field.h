// The error of a whole path on a machine: what a person is shown and a report says.
#pragma once

#include "core/base/progress.h"
#include "core/geometry/closest_point.h"
#include "core/grid/error_model.h"
#include "core/toolpath/sequencing.h"

#include <vector>

namespace millwright::toolpath {

/// The worst of one move. Lengths mm, angles rad.
struct MoveDeviation {
    MoveKind kind = MoveKind::track;
    /// Largest distance of the true tip from the nearest surface point; of a cutter by how much its body
    /// misses or enters the surface near the contact.
    double closest = 0.0;
    double param = 0.0;    ///< largest distance from the tip intended at the same fraction of the parameters
    double axis = 0.0;     ///< largest angle between tool axis and the one intended at the nearest point
    double length = 0.0;   ///< of the straight move
    double worst_at = 0.5; ///< t of the largest `closest`
};

struct ErrorField {
    std::vector<MoveDeviation> moves; ///< one per move: points.size() - 1
};

/// When the true pose is compared inside each move.
struct MoveSampling {
    /// At t = k / (times + 1), k = 1 ... times; 1 is the mid-point of the thesis. 0: as often and where it
    /// takes to know the largest `closest`, ends included, to a thousandth and to 1 um at worst, the largest
    /// `axis` to a thousandth of a degree and the largest `param` to a hundredth (1 to 10 um); with a cutter
    /// as far as its local search finds the same place from look to look. A move over what is not cut is
    /// looked at once.
    int times = 0;

    friend bool operator==(const MoveSampling&, const MoveSampling&) = default;
};
inline constexpr MoveSampling until_known{};

/// Of `toolpath.tool`. Parallel over moves; the same bytes on any number of threads.
[[nodiscard]] ErrorField error_field(const geometry::ParametricSurface& patch,
                                     const kinematics::MachineModel& machine,
                                     const Toolpath& toolpath,
                                     const AxisPath& axes,
                                     MoveSampling sampling,
                                     const Progress& progress);

enum class Distance { closest, param };

/// The figures over the moves of one kind. All zero if there is no such move.
[[nodiscard]] grid::ErrorSummary summary(const ErrorField& field, Distance distance, MoveKind kind);

} // namespace millwright::toolpath
