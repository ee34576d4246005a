// What the whole tool does to the surface on its way: how high over each point of a raster the swept cutter
// begins (material left: scallops) or how deep below it (gouges), and which move brings cutter or holder into
// the part. Every point against the body at every moment that can matter; lengths mm.
#pragma once

#include "core/base/progress.h"
#include "core/geometry/parametric_surface.h"
#include "core/kinematics/machine_model.h"
#include "core/toolpath/tool.h"

#include <span>
#include <vector>

namespace millwright::toolpath {

/// All axes straight from one position to another.
struct SweptMove {
    kinematics::AxisPositions from, to;
    bool cuts = true; ///< takes part in what is left; what does not is only asked whether it hits
};

struct SweepSettings {
    int nu = 100, nv = 100; ///< points of the raster at equal parameter steps, 2 or more
    double step = 0.15;     ///< mm of the tip's way between two looks; four times that where nothing is cut
    double highest = 5.0;   ///< mm: material that is higher is taken for not cut
    /// The least height of each point is looked for between two looks, too: under an edge it changes with the
    /// way, not with its square as under an arc.
    bool between_looks = false;
};

/// How deep one body comes below the surface.
struct Bite {
    double depth = 0.0; ///< 0: it stays out
    Vec2 uv = Vec2::Zero();
    Vec3 position = Vec3::Zero(); ///< the surface point
};

struct MoveBites {
    Bite cutter, holder;
};

struct SweptCut {
    int nu = 0, nv = 0;
    /// [nu x nv], row = u: along the normal; below 0: cut too deep; infinity: not cut
    std::vector<double> heights;
    std::vector<MoveBites> moves; ///< one per move

    [[nodiscard]] double height(int i, int j) const {
        return heights[static_cast<std::size_t>(i) * static_cast<std::size_t>(nv) +
                       static_cast<std::size_t>(j)];
    }
};

/// `flipped`: the tool is on the side against S_u x S_v. Points without a normal are left out. The deepest
/// bite of a move is sharpened by a descent on the surface. Parallel over moves; the same bytes on any number
/// of threads. Throws Defect without a cutter, and Cancelled.
[[nodiscard]] SweptCut swept_cut(const geometry::ParametricSurface& patch,
                                 bool flipped,
                                 const kinematics::MachineModel& machine,
                                 const Tool& tool,
                                 std::span<const SweptMove> moves,
                                 const SweepSettings& settings,
                                 const Progress& progress = Progress());

} // namespace millwright::toolpath
