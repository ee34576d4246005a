// The error of a real machine as the grid room sees it (grid::ErrorModel).
#pragma once

#include "core/geometry/parametric_surface.h"
#include "core/grid/error_model.h"
#include "core/kinematics/machine_model.h"
#include "core/toolpath/sequenced_path.h"
#include "core/toolpath/tool.h"

#include <memory>

namespace millwright::toolpath {

/// The move from a to b: both poses by inverse kinematics, branch of b nearest to a, axes linear in between.
/// `tip`: largest distance of the true tip from the surface curve between the nodes; of a cutter by how much
/// its bottom (internal/tool_curve.h) misses or enters the surface, and how far beside its way. `axis`:
/// largest angle of the true axis to that wanted there. A tool that leans is judged on and back, by the
/// worse. On a pole the free angle is that of the other end: no rotation in place. Unlike on the path, each
/// move chooses its branches for itself: `sequencing` and what else the body touches count in `on_path`.
class KinematicError final : public grid::ErrorModel {
public:
    /// Keeps surface.shared().
    KinematicError(const geometry::ParametricSurface& patch,
                   kinematics::MachineModel machine,
                   bool flipped,
                   Tool tool = {},
                   SequencingSettings sequencing = {});

    [[nodiscard]] grid::MoveError move(const Vec2& a, const Vec2& b, grid::Sampling sampling) const override;
    [[nodiscard]] std::unique_ptr<grid::LatticeErrors> lattice(std::span<const Vec2> nodes,
                                                               grid::Sampling sampling) const override;
    [[nodiscard]] double track_gap(const grid::Grid& grid, grid::TrackDirection direction) const override;
    /// Closest distance of the tool from the surface, over the moves inside the tracks.
    [[nodiscard]] grid::ErrorSummary
    on_path(const grid::Grid& grid, grid::TrackDirection direction, const Progress& progress) const override;

    [[nodiscard]] const geometry::ParametricSurface& patch() const { return *patch_; }

private:
    std::shared_ptr<const geometry::ParametricSurface> patch_;
    kinematics::MachineModel machine_;
    bool flipped_ = false;
    Tool tool_;
    SequencingSettings sequencing_;
};

} // namespace millwright::toolpath
