// The surface under a grid with the errors of the moves spread over it.
#pragma once

#include "core/plan/evaluation.h"
#include "ui/render/mesh_drawer.h"

namespace millwright::viewport {

/// Each node takes the larger error of its two moves inside the track; between nodes errors are blended.
/// `value` is the closest distance, mm.
[[nodiscard]] render::MeshBuffer error_surface(const plan::CuttingSetup& cutting_setup,
                                               const plan::Evaluation& shown);

} // namespace millwright::viewport
