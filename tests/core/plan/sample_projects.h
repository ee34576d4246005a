// Shipped projects, made small for tests.
#pragma once

#include "core/plan/plan.h"
#include "core/project/project_file.h"

#include <string>

namespace millwright::test {

inline const plan::Folders asset_folders{{}, "assets"};
inline const plan::Folders sample_folders{"assets/projects", "assets"};

inline project::Project small_sample(const std::string& name, int nodes) {
    project::Project project = project::read_project("assets/projects/" + name + ".json");
    project.grid.nu = nodes;
    project.grid.nv = nodes;
    project.grid.tracks.lattice = 40; // enough for a test
    project.grid.tracks.polish_sweeps = 3;
    return project;
}

} // namespace millwright::test
