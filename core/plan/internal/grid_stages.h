// The stages that make the grids of a project: carried over, coarse and exact.
#pragma once

#include "core/plan/internal/stage.h"

namespace millwright::plan {

/// What another stage reads of a grid.
[[nodiscard]] constexpr StageKey grid_key(project::GridMethod method) {
    return {StageKind::grid, method};
}

/// Of the uniform grid, of the program's, or of one that is compared with it.
[[nodiscard]] Stage
grid_stage(project::GridMethod method, const project::Project& project, const Scope& scope);

/// Larger grids take longer than a person who drags waits for.
[[nodiscard]] bool is_quick(const project::GridInput& input);

[[nodiscard]] bool same_nodes(const project::GridInput& a, const project::GridInput& b);

/// Fewer samples where there are many moves, so that a drag stays a drag.
[[nodiscard]] toolpath::MoveSampling sampling_of(Quality quality, const project::GridInput& input);

/// What the exact result replaces bears the status of a running work, by which people see it.
[[nodiscard]] std::shared_ptr<const Evaluation> shared(Evaluation found, Quality quality);

} // namespace millwright::plan
