// Projects and what is derived from them, for tests of pictures.
#pragma once

#include "core/plan/plan.h"
#include "tests/ui/viewport/scenes.h"

#include <string>
#include <utility>

namespace millwright::test {

struct Planned {
    project::Project project;
    plan::Plan plan;
};

/// The bent grid stands for the optimised one.
inline Planned planned(const Part& part, std::string name = "Dome") {
    const viewport::Scene scene = scene_of(part, viewport::ViewKind::design);
    Planned made;
    made.project.name = std::move(name);
    made.project.grid.nu = made.project.grid.nv = part.nodes;
    made.plan.surface = scene.surface;
    made.plan.cutting_setup = scene.cutting_setup;
    made.plan.singular_points = scene.singular_points;
    made.plan.grid(project::GridMethod::uniform).evaluation = scene.shown;
    made.plan.grid(project::GridMethod::tracks).evaluation =
        evaluation(*scene.cutting_setup, bent_grid(part.nodes));
    return made;
}

} // namespace millwright::test
