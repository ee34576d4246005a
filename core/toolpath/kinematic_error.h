// The error of a real machine as the grid room sees it (grid::ErrorModel).
#pragma once

#include "core/geometry/bezier_patch.h"
#include "core/grid/error_model.h"
#include "core/kinematics/machine_model.h"
#include "core/toolpath/sequenced_path.h"
#include "core/toolpath/tool.h"

namespace millwright::toolpath {

/// The move from a to b: both poses by inverse kinematics, branch of b nearest to a, axes linear in between;
/// `tip` is the largest distance of the true tip from the surface curve between the nodes, `axis` the largest
/// angle of the true tool axis to the normal at the nearest point of that curve. A pose on the machine's pole
/// takes the free angle of the other end, so that the move is judged without a rotation in place.
/// Unlike on the path, each move chooses its branches for itself, and the tool is a point along the normal:
/// what cuts has its say in `on_path`, and how the branches are chosen, `sequencing` (without added points).
class KinematicError final : public grid::ErrorModel {
public:
    KinematicError(geometry::BezierPatch patch,
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

    [[nodiscard]] const geometry::BezierPatch& patch() const { return patch_; }

private:
    geometry::BezierPatch patch_;
    kinematics::MachineModel machine_;
    bool flipped_ = false;
    Tool tool_;
    SequencingSettings sequencing_;
};

} // namespace millwright::toolpath
