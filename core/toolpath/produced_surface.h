// The surface that the machine makes: the true tracks of the tool, joined by straight lines from track to
// track. Source: Parasilmongkol 1997, ch. 3 eqs 10 and 11 (corrected), which take the middle of each move.
#pragma once

#include "core/kinematics/machine_model.h"
#include "core/toolpath/sequencing.h"
#include "core/toolpath/toolpath.h"

#include <optional>
#include <vector>

namespace millwright::toolpath {

/// Points T of the produced surface, mm: row `t` lies on track t, the columns run along it, in the direction
/// of growing node numbers on every track.
struct ProducedSurface {
    int tracks = 0;
    int places = 0;           ///< along each track: moves * steps + 1
    std::vector<Vec3> points; ///< [tracks x places]

    [[nodiscard]] const Vec3& at(int track, int place) const {
        return points[static_cast<std::size_t>(track) * static_cast<std::size_t>(places) +
                      static_cast<std::size_t>(place)];
    }
};

/// `steps` places per move (an even number has its middle among them) of the path that `axes` follow. Nothing
/// where the path has no tracks of equally many moves side by side, as a spiral or a path with added points,
/// and for a cutter, whose tip is not where it cuts. Throws Defect for less than one step.
[[nodiscard]] std::optional<ProducedSurface> produced_surface(const kinematics::MachineModel& machine,
                                                              const Toolpath& path,
                                                              const AxisPath& axes,
                                                              int steps);

} // namespace millwright::toolpath
