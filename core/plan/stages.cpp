#include "core/plan/internal/stages.h"

#include "core/plan/cut_study.h"
#include "core/plan/internal/failure.h"
#include "core/plan/internal/grid_stages.h"
#include "core/plan/strategy_path.h"
#include "core/project/assets.h"
#include "core/project/part_trims.h"
#include "core/project/surface.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace millwright::plan {

namespace {

using project::GridMethod;

/// Whether both tools make the same path; by what the cut is judged may differ, and what the program calls
/// them.
bool same_cutter(project::ToolInput a, const project::ToolInput& b) {
    a.scallop_mm = b.scallop_mm;
    a.gouge_limit_mm = b.gouge_limit_mm;
    a.number = b.number;
    return a == b;
}

constexpr StageKey the_region{StageKind::region};
constexpr StageKey the_cutting_setup{StageKind::cutting_setup};
constexpr StageKey the_program{StageKind::program};

std::vector<Quality> coarse_if(bool quick) {
    return quick ? std::vector{Quality::coarse, Quality::exact} : std::vector{Quality::exact};
}

Stage surface_stage() {
    return {.key = {StageKind::surface},
            .same =
                [](const Source& then, const Source& now) {
                    return then.project.surface.patches == now.project.surface.patches &&
                           then.project.surface.face == now.project.surface.face &&
                           then.project.surface.joined == now.project.surface.joined;
                },
            .make =
                [](const StageWork& work) {
                    work.plan.surface = std::make_shared<const geometry::Surface>(
                        project::surface_of(work.project().surface));
                    return true;
                },
            .clear = [](Plan& plan) { plan.surface = nullptr; },
            .qualities = {Quality::carried, Quality::exact}};
}

Stage trims_stage() {
    return {.key = {StageKind::trims},
            .same =
                [](const Source& then, const Source& now) {
                    return project::part_trims(then.project.surface) ==
                           project::part_trims(now.project.surface);
                },
            .make =
                [](const StageWork& work) {
                    work.plan.trims = std::make_shared<const std::vector<geometry::Trim>>(
                        project::part_trims(work.project().surface));
                    return true;
                },
            .clear = [](Plan& plan) { plan.trims = nullptr; },
            .qualities = {Quality::carried, Quality::exact}};
}

/// Of several faces, which takes about a second. A patch or a face is its own region.
Stage region_stage(const project::Project& project) {
    const bool joins = project.surface.joined.has_value();
    return {
        .key = the_region,
        .title = joins ? "Joining the faces" : "",
        .share = joins ? 0.1 : 0.0,
        .same = [](const Source& then,
                   const Source& now) { return then.project.surface.joined == now.project.surface.joined; },
        .make =
            [](const StageWork& work) {
                if (const auto& joined = work.project().surface.joined) {
                    refuse_faults(work.project());
                    work.plan.joined = std::make_shared<const region::JoinedRegion>(
                        project::joined_region(*joined, work.progress));
                }
                return true;
            },
        .clear = [](Plan& plan) { plan.joined = nullptr; },
        .qualities = {Quality::carried, Quality::exact}};
}

/// Nothing holds, and nothing is made, of a project with faults but its surface.
Stage cutting_setup_stage() {
    return {.key = the_cutting_setup,
            .reads = {the_region},
            .same =
                [](const Source& then, const Source& now) {
                    return same_cutting_setup(then, now) && project::faults_of(now.project).empty();
                },
            .make =
                [](const StageWork& work) {
                    refuse_faults(work.project());
                    const project::Project& project = work.project();
                    work.plan.cutting_setup = std::make_shared<const CuttingSetup>(cutting_setup_of(
                        project,
                        work.source.folders,
                        work.plan.joined ? work.plan.joined->region
                                         : project::machined_region(project.surface, work.progress)));
                    return true;
                },
            .clear = [](Plan& plan) { plan.cutting_setup = nullptr; },
            .qualities = {Quality::carried, Quality::exact}};
}

Stage singular_points_stage() {
    return {.key = {StageKind::singular_points},
            .reads = {the_cutting_setup},
            .same = [](const Source&, const Source&) { return true; },
            .make =
                [](const StageWork& work) {
                    work.plan.singular_points =
                        toolpath::singular_points(work.cutting_setup().patch, work.cutting_setup().machine);
                    return true;
                },
            .clear = [](Plan& plan) { plan.singular_points.clear(); },
            .qualities = {Quality::coarse, Quality::exact}};
}

/// A strategy that makes its own points waits for the exact result: it takes longer than a person who drags.
Stage path_stage(const project::Project& project) {
    return {.key = {StageKind::path},
            .title = title_of_path,
            .share = 0.1,
            .asked = has_own_path(project),
            .reads = {the_cutting_setup, grid_key(GridMethod::uniform), grid_key(program_grid(project))},
            .same =
                [](const Source& then, const Source& now) {
                    return has_own_path(now.project) && has_own_path(then.project) &&
                           strategy_settings(then.project) == strategy_settings(now.project);
                },
            .make =
                [](const StageWork& work) {
                    work.plan.path =
                        shared(path_evaluation(work.project(),
                                               work.cutting_setup(),
                                               *work.plan.grid(program_grid(work.project())).evaluation,
                                               *work.plan.grid(GridMethod::uniform).evaluation,
                                               sampling_of(work.quality, work.project().grid),
                                               work.progress),
                               work.quality);
                    return true;
                },
            .clear =
                [](Plan& plan) {
                    plan.path = nullptr;
                    plan.path_time.reset();
                },
            .qualities = coarse_if(follows_nodes(project.toolpath.strategy) && is_quick(project.grid)),
            .graded = true};
}

StageKey key_of_path(const project::Project& project) {
    return has_own_path(project) ? StageKey{StageKind::path} : grid_key(program_grid(project));
}

bool same_program(const Source& then, const Source& now) {
    const project::Project &a = then.project, &b = now.project;
    return a.program == b.program && a.name == b.name && a.tool.number == b.tool.number &&
           a.toolpath == b.toolpath && program_grid(a) == program_grid(b);
}

/// With listing, trajectory and time.
Stage program_stage(const project::Project& project) {
    return {.key = the_program,
            .title = "Writing the program",
            .share = 0.1,
            .reads = {the_cutting_setup, grid_key(GridMethod::uniform), key_of_path(project)},
            .same = same_program,
            .make =
                [](const StageWork& work) {
                    if (!work.plan.program_path(work.project())) {
                        return false;
                    }
                    add_program(work.plan, work.project(), work.progress);
                    return true;
                },
            .clear =
                [project](Plan& plan) {
                    plan.program = nullptr;
                    plan.program_notes = {};
                    plan.listing = nullptr;
                    plan.trajectory = nullptr;
                    plan.program_time(project).reset();
                },
            .qualities = coarse_if(is_quick(project.grid)),
            .shown_early = Quality::exact};
}

bool same_tool_and_program(const Source& then, const Source& now) {
    return then.project.tool == now.project.tool && then.project.program == now.project.program;
}

Stage cut_stage(const project::Project& project, const Scope& scope) {
    return {.key = {StageKind::cut},
            .share = 0.1,
            .asked = scope.cut,
            .reads = {the_cutting_setup, key_of_path(project), the_program},
            .same = same_tool_and_program,
            .make =
                [](const StageWork& work) {
                    add_cut_study(work.plan, work.project(), work.progress);
                    return true;
                },
            .clear = [](Plan& plan) { plan.cut = nullptr; },
            .shown_early = Quality::exact};
}

bool same_weight(const Source& then, const Source& now) {
    const project::EllipticInput &a = then.project.grid.elliptic, &b = now.project.grid.elliptic;
    return a.weight == b.weight && a.expression == b.expression && a.mix == b.mix && a.painted == b.painted &&
           a.region == b.region && same_nodes(then.project.grid, now.project.grid);
}

Stage weight_stage(const project::Project& project, const Scope& scope) {
    return {.key = {StageKind::weight},
            .share = 0.02,
            .asked = scope.weight,
            .reads = {the_cutting_setup},
            .same = same_weight,
            .make =
                [](const StageWork& work) {
                    work.plan.weight = std::make_shared<const WeightMap>(
                        weight_map(work.project().grid, work.cutting_setup(), work.progress));
                    return true;
                },
            .clear = [](Plan& plan) { plan.weight = nullptr; },
            .qualities = coarse_if(is_quick(project.grid)),
            .fault_of = GridMethod::elliptic};
}

/// Of the grids that are there beside the program's, which has its time from its trajectory.
Stage time_stage(GridMethod method, const Scope& scope) {
    return {.key = {StageKind::time, method},
            .share = 0.01,
            .asked = scope.times,
            .reads = {the_cutting_setup, grid_key(method)},
            .same = [](const Source& then,
                       const Source& now) { return then.project.program == now.project.program; },
            .make =
                [method](const StageWork& work) {
                    GridResult& grid = work.plan.grid(method);
                    if (!grid.evaluation) {
                        return false;
                    }
                    grid.estimated_time = estimated_time(*grid.evaluation,
                                                         work.cutting_setup().machine,
                                                         work.project().program,
                                                         work.progress);
                    return true;
                },
            .clear = [method](Plan& plan) { plan.grid(method).estimated_time.reset(); }};
}

Stage unsequenced_stage(const project::Project& project, const Scope& scope) {
    return {.key = {StageKind::unsequenced},
            .share = 0.02,
            .asked = scope.unsequenced && project.sequencing != project::SequencingInput{},
            .reads = {the_cutting_setup, key_of_path(project)},
            .same =
                [](const Source& then, const Source& now) {
                    return then.project.program == now.project.program &&
                           then.project.sequencing == now.project.sequencing &&
                           strategy_settings(then.project) == strategy_settings(now.project);
                },
            .make =
                [](const StageWork& work) {
                    // only compared with: without it there is a program all the same
                    work.plan.unsequenced_failure =
                        failure_of([&] { add_unsequenced(work.plan, work.project(), work.progress); });
                    return true;
                },
            .clear =
                [](Plan& plan) {
                    plan.unsequenced = nullptr;
                    plan.unsequenced_time.reset();
                    plan.unsequenced_failure.reset();
                }};
}

/// Of the grids that are there beside the program's.
Stage compared_cut_stage(GridMethod method, const Scope& scope) {
    return {.key = {StageKind::compared_cut, method},
            .share = 0.1,
            .asked = scope.compared.cuts,
            .reads = {the_cutting_setup, grid_key(method)},
            .same = same_tool_and_program,
            .make =
                [method](const StageWork& work) {
                    add_compared_cut(method, work.plan, work.project(), work.progress);
                    return work.plan.grid(method).cut != nullptr;
                },
            .clear = [method](Plan& plan) { plan.grid(method).cut = nullptr; }};
}

} // namespace

Source source_of(const project::Project& project, const Folders& folders) {
    namespace fs = std::filesystem;
    std::error_code failure;
    auto written = fs::file_time_type::min(); // of a machine that is not found
    try {
        written =
            fs::last_write_time(project::machine_path(project, folders.project, folders.assets), failure);
    } catch (const Error&) { // reported where the machine is read
    }
    return {project, folders, written};
}

bool same_cutting_setup(const Source& then, const Source& now) {
    const project::Project &a = then.project, &b = now.project;
    return a.surface == b.surface && a.machine == b.machine && same_cutter(a.tool, b.tool) &&
           a.grid.direction == b.grid.direction && sequencing_settings(a) == sequencing_settings(b) &&
           timing(a) == timing(b) && then.folders == now.folders &&
           then.machine_written == now.machine_written;
}

std::vector<Stage> stages_of(const project::Project& project, const Scope& scope) {
    const GridMethod of_program = program_grid(project);
    std::vector<Stage> stages{surface_stage(),
                              trims_stage(),
                              region_stage(project),
                              cutting_setup_stage(),
                              singular_points_stage(),
                              grid_stage(GridMethod::uniform, project, scope)};
    if (of_program != GridMethod::uniform) {
        stages.push_back(grid_stage(of_program, project, scope));
    }
    stages.push_back(path_stage(project));
    stages.push_back(program_stage(project));
    stages.push_back(cut_stage(project, scope));
    stages.push_back(weight_stage(project, scope));
    for (const GridMethod method : project::every_grid_method) {
        if (method != GridMethod::uniform && method != of_program) {
            stages.push_back(grid_stage(method, project, scope));
        }
    }
    const auto add_for_compared = [&](auto stage_of) {
        for (const GridMethod method : project::every_grid_method) {
            if (grid_key(method) != key_of_path(project)) {
                stages.push_back(stage_of(method, scope));
            }
        }
    };
    add_for_compared(time_stage);
    stages.push_back(unsequenced_stage(project, scope));
    add_for_compared(compared_cut_stage);
    return stages;
}

} // namespace millwright::plan
