#include "core/plan/report.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/plan/cut_remarks.h"
#include "core/plan/cut_study.h"
#include "core/plan/largest_error.h"
#include "core/plan/skipped_comparisons.h"
#include "core/plan/strategy_path.h"
#include "core/project/grid_methods/grid_method_row.h"
#include "core/project/json_text.h"
#include "core/project/setting_tables.h"
#include "core/project/tool_json.h"
#include "core/project/tool_settings.h"
#include "core/project/version.h"
#include "core/toolpath/shortest_sequence.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace millwright::plan {

namespace {

using Json = nlohmann::ordered_json;
using project::GridMethod;

std::string_view status_id(grid::OptimiserStatus status) {
    switch (status) {
    case grid::OptimiserStatus::running:
        return "running";
    case grid::OptimiserStatus::converged:
        return "converged";
    case grid::OptimiserStatus::iteration_limit:
        return "iteration-limit";
    case grid::OptimiserStatus::no_gain:
        return "no-gain";
    case grid::OptimiserStatus::folded:
        return "folded";
    case grid::OptimiserStatus::not_finite:
        return "not-finite";
    case grid::OptimiserStatus::singular:
        return "singular";
    }
    return "unknown";
}

/// A norm, which is no number any more where a solver ran away.
Json norm_of(const GridOutcome& outcome) {
    return std::isfinite(outcome.norm) ? Json(outcome.norm) : Json();
}

Json distances(const grid::ErrorSummary& figures) {
    Json json;
    json["max"] = project::rounded(figures.max);
    json["mean"] = project::rounded(figures.mean);
    json["lmean"] = project::rounded(figures.lmean);
    json["rms"] = project::rounded(figures.rms);
    json["p95"] = project::rounded(figures.p95);
    json["variance"] = project::rounded(figures.variance);
    return json;
}

Json gap_of(const Evaluation& evaluation) {
    return evaluation.track_gap ? Json(project::rounded(*evaluation.track_gap)) : Json();
}

/// Null where nodes that are never cut cannot be reached, or have no normal: a
/// grid is measured over all.
Json known(double figure) {
    return std::isfinite(figure) ? Json(project::rounded(figure)) : Json();
}

Json links_of(const GridOutcome& outcome) {
    Json json = Json::array();
    for (const grid::ChainStage& stage : outcome.stages) {
        json.push_back({{"name", stage.name},
                        {"max", known(stage.reached.max)},
                        {"mean", known(stage.reached.mean)},
                        {"axis_max_deg", known(to_degrees(stage.reached.axis_max))},
                        {"best_max", known(stage.of_best.max)},
                        {"best_mean", known(stage.of_best.mean)},
                        {"best_axis_max_deg", known(to_degrees(stage.of_best.axis_max))},
                        {"refused", stage.refused}});
    }
    return json;
}

Json errors(const Plan& plan,
            const Evaluation& evaluation,
            const std::optional<double>& time,
            const std::optional<grid::ErrorSummary>& by_curve) {
    Json json;
    json["closest"] = distances(evaluation.closest);
    if (const auto bounds = largest_error_bounds(*plan.cutting_setup, evaluation)) {
        json["closest"]["max_at_least"] = project::rounded(bounds->at_least);
    }
    json["param"] = distances(evaluation.param);
    json["curve"] = by_curve && std::isfinite(by_curve->max) ? distances(*by_curve) : Json();
    json["axis_deviation_deg"]["max"] = project::rounded(to_degrees(evaluation.closest.axis_max));
    json["axis_deviation_deg"]["mean"] = project::rounded(to_degrees(evaluation.closest.axis_mean));
    json["track_gap_mm"] = gap_of(evaluation);
    json["cross"]["max"] = project::rounded(evaluation.cross_closest.max);
    json["cross"]["mean"] = project::rounded(evaluation.cross_closest.mean);
    json["min_jacobian"] = project::rounded(evaluation.outcome.grid.min_jacobian());
    json["points"] = std::ssize(evaluation.toolpath.points);
    json["path_length_mm"] = project::rounded(evaluation.path_length);
    json["estimated_time_s"] = time ? Json(project::rounded(*time)) : Json();
    json["rotary_travel_deg"] = project::rounded(to_degrees(evaluation.axes.rotary_travel));
    json["largest_rotary_step_deg"] = project::rounded(to_degrees(toolpath::largest_rotary_step(
        plan.cutting_setup->machine, evaluation.toolpath, evaluation.axes, toolpath::MoveKind::track)));
    json["status"] = status_id(evaluation.outcome.status);
    json["rounds"] = evaluation.outcome.rounds;
    json["iterations"] = evaluation.outcome.iterations;
    json["norm"] = norm_of(evaluation.outcome);
    json["note"] = evaluation.outcome.note;
    json["warning"] = evaluation.outcome.warning;
    if (!evaluation.outcome.stages.empty()) {
        json["links"] = links_of(evaluation.outcome);
    }
    return json;
}

Json errors(const Plan& plan, GridMethod method) {
    const Evaluation& evaluation = *plan.grid(method).evaluation;
    auto by_curve = evaluation.outcome.by_curve;
    if (method == GridMethod::uniform && plan.grid(GridMethod::tracks).evaluation) {
        by_curve = plan.grid(GridMethod::tracks).evaluation->outcome.start_by_curve;
    }
    return errors(plan, evaluation, plan.grid(method).estimated_time, by_curve);
}

/// Of every grid that is there, and of the path where it is none of theirs.
Json all_errors(const project::Project& project, const Plan& plan) {
    Json json;
    for (const GridMethod method : project::every_grid_method) {
        const std::string key(row_of(method).report_key);
        if (plan.grid(method).evaluation) {
            json[key] = errors(plan, method);
        } else if (const auto& failure = plan.grid(method).failure) {
            json[key] = {{"failed", to_text(*failure)}};
        } else if (is_comparison_skipped(project, method)) {
            json[key] = {{"left_out", skipped_comparisons_sentence(project)}};
        }
    }
    if (has_own_path(project)) {
        json["path"] = errors(plan, *plan.path, plan.path_time, std::nullopt);
    }
    return json;
}

Json surface_json(const project::Project& project, const Plan& plan) {
    const project::SurfaceInput& surface = project.surface;
    const region::Region& patch = plan.cutting_setup->patch;
    Json json;
    json["preset"] = surface.preset;
    json["patches"] = plan.surface->patch_count();
    json["machined_patch"] = surface.machined_patch;
    if (plan.joined) {
        json["faces"] = Json::array();
        for (const project::JoinedFace& face : surface.joined->faces) {
            json["faces"].push_back(face.number);
        }
        json["flattening"] = std::string(region::name_of(plan.joined->flattening.method));
        json["distortion"] = plan.joined->flattening.distortion;
        json["boundary_off_mm"] = plan.joined->boundary_off;
    } else if (surface.face) {
        const geometry::BsplineNet& net = surface.face->net;
        json["degree"] = Json::array({net.degree_u, net.degree_v});
        json["control_points"] = Json::array({net.rows, net.columns});
        json["rational"] = plan.surface->faces().front().rational();
    } else {
        const geometry::PatchId machined{surface.machined_patch};
        const geometry::BezierPatch& bezier = plan.surface->patch(machined);
        json["degree"] = Json::array({bezier.degree_u(), bezier.degree_v()});
        json["rational"] = bezier.rational();
    }
    json["flipped"] = project.surface.flipped;
    json["box_mm"]["min"] = project::vector(patch.control_box().min());
    json["box_mm"]["max"] = project::vector(patch.control_box().max());
    return json;
}

Json machine_json(const project::Project& project, const Plan& plan) {
    const kinematics::MachineModel& model = plan.cutting_setup->machine;
    Json json;
    json["file"] = project.machine.file;
    json["name"] = model.name();
    std::string letters;
    for (const kinematics::MachineAxis& axis : model.axes()) {
        letters += axis.letter;
    }
    json["axes"] = letters;
    json["workpiece_offset_mm"] = project::vector(model.description().workpiece_offset);
    json["angle_mode"] = project::row_of(project::angle_modes(), project.machine.angle_mode).id;
    json["sequencing"] = project::row_of(project::sequencing_goals(), project.sequencing.goal).id;
    json["largest_step_deg"] = project.sequencing.largest_step_deg;
    return json;
}

Json tool(const project::ToolInput& input, const kinematics::MachineModel& machine) {
    const std::optional<double> length = machine.description().tool_length;
    Json json = project::json_of(input);
    json["text"] = project::tool_text(input);
    json["assumed_gauge_length_mm"] = length ? Json(project::rounded(*length)) : Json();
    json["assumed_length"] = project::tool_length_text(input, machine);
    return json;
}

/// What the cutter does; cut.json has the whole of it.
Json cut(const project::Project& project, const CutStudy& study) {
    Json json;
    json["checked"] = checked_text(project);
    json["scallop_mm"]["max"] = project::rounded(study.scallops.max);
    json["scallop_mm"]["mean"] = project::rounded(study.scallops.mean);
    json["gouged_percent"] = project::rounded(100.0 * study.scallops.gouged);
    json["not_cut_percent"] = project::rounded(100.0 * study.scallops.not_cut);
    json["deepest_cut_below_surface_mm"] = project::rounded(study.deepest);
    json["bites"] = std::ssize(study.bites);
    json["local_gouges"] = std::ssize(study.local_gouges);
    return json;
}

Json grid_json(const project::Project& project, const Evaluation& chosen) {
    const GridOutcome& outcome = chosen.outcome;
    Json json;
    json["nu"] = outcome.grid.nu();
    json["nv"] = outcome.grid.nv();
    json["direction"] = project::row_of(project::track_directions(), project.grid.direction).id;
    json["method"] = row_of(program_grid(project)).id;
    json["strategy"] = project::row_of(project::strategies(), project.toolpath.strategy).id;
    json["status"] = status_id(outcome.status);
    json["rounds"] = outcome.rounds;
    json["iterations"] = outcome.iterations;
    json["norm"] = norm_of(outcome);
    json["min_jacobian"] = project::rounded(outcome.grid.min_jacobian());
    json["note"] = outcome.note;
    json["warning"] = outcome.warning;
    return json;
}

Json singular_points(const Plan& plan) {
    Json json = Json::array();
    for (const toolpath::SingularPoint& point : plan.singular_points) {
        Json entry;
        entry["u"] = project::rounded(point.uv.x());
        entry["v"] = project::rounded(point.uv.y());
        entry["position_mm"] = project::vector(point.position);
        json.push_back(std::move(entry));
    }
    return json;
}

Json program_json(const Plan& plan) {
    const program::PostNotes& notes = plan.program_notes;
    Json json;
    json["blocks"] = plan.program->block_count();
    json["lines"] = plan.listing->line_count();
    json["cut_moves"] = notes.cut_moves;
    json["slowed_moves"] = notes.slowed_moves;
    json["links"] = notes.links;
    json["raised_links"] = notes.raised_links;
    json["safe_height_links"] = notes.safe_height_links;
    json["cut_length_mm"] = project::rounded(notes.cut_length);
    return json;
}

} // namespace

std::string report_text(const project::Project& project, const Plan& plan) {
    const bool compared = std::ranges::all_of(project::every_grid_method, [&](GridMethod method) {
        return !row_of(method).compared || plan.grid(method).evaluation || plan.grid(method).failure ||
               is_comparison_skipped(project, method);
    });
    expects(plan.grid(GridMethod::uniform).evaluation && compared && plan.program && plan.listing &&
                plan.trajectory,
            "a plan is complete before it is reported");
    const Evaluation& chosen = *plan.program_path(project);
    Json json;
    json["format"] = "millwright-report";
    json["version"] = 1;
    json["made_by"] = "Millwright " + std::string(project::version());
    json["project"] = project.name;
    json["surface"] = surface_json(project, plan);
    json["machine"] = machine_json(project, plan);
    json["tool"] = tool(project.tool, plan.cutting_setup->machine);
    json["grid"] = grid_json(project, chosen);
    json["error"] = all_errors(project, plan);
    json["singular_points"] = singular_points(plan);
    json["points"] = std::ssize(chosen.toolpath.points);
    json["path_length_mm"] = project::rounded(chosen.path_length);
    json["track_gap_mm"] = gap_of(chosen);
    json["estimated_time_s"] = project::rounded(plan.trajectory->duration());
    json["axis_deviation_deg"]["max"] = project::rounded(to_degrees(chosen.closest.axis_max));
    json["axis_deviation_deg"]["mean"] = project::rounded(to_degrees(chosen.closest.axis_mean));
    json["remarks"] = path_remarks(project, plan);
    json["program"] = program_json(plan);
    if (plan.cut) {
        json["cut"] = cut(project, *plan.cut);
    }
    return project::json_text(json);
}

} // namespace millwright::plan
