#include "core/base/error.h"
#include "core/base/units.h"
#include "core/plan/cut_remarks.h"
#include "core/plan/cut_study.h"
#include "core/plan/strategy_path.h"
#include "core/project/grid_methods/grid_method_row.h"
#include "core/project/json_text.h"
#include "core/project/setting_tables.h"
#include "core/project/tool_settings.h"
#include "core/project/version.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <optional>

namespace millwright::plan {

namespace {

using Json = nlohmann::ordered_json;

Json bites(const CutStudy& study) {
    Json json = Json::array();
    for (const BlockBite& bite : study.bites) {
        Json entry;
        entry["block"] = bite.block;
        entry["line"] = bite.line;
        entry["body"] = bite.by_holder ? "holder" : "cutter";
        entry["depth_mm"] = project::rounded(bite.bite.depth);
        entry["u"] = project::rounded(bite.bite.uv.x());
        entry["v"] = project::rounded(bite.bite.uv.y());
        entry["position_mm"] = project::vector(bite.bite.position);
        json.push_back(std::move(entry));
    }
    return json;
}

Json local_gouges_json(const CutStudy& study) {
    Json json = Json::array();
    for (const LocalGouge& gouge : study.local_gouges) {
        Json entry;
        entry["node"] = Json::array({gouge.origin.i, gouge.origin.j});
        entry["relative_curvature_per_mm"] = std::isfinite(gouge.relative_curvature)
                                                 ? Json(project::rounded(gouge.relative_curvature))
                                                 : Json();
        entry["position_mm"] = project::vector(gouge.contact);
        json.push_back(std::move(entry));
    }
    return json;
}

} // namespace

std::string cut_report_text(const project::Project& project, const Plan& plan) {
    expects(plan.cut && plan.trajectory, "a plan has its study before it is reported");
    const CutStudy& study = *plan.cut;
    const Evaluation& evaluation = *plan.program_path(project);
    Json json;
    json["format"] = "millwright-cut";
    json["version"] = 1;
    json["made_by"] = "Millwright " + std::string(project::version());
    json["project"] = project.name;
    json["tool"] = project::tool_text(project.tool);
    json["tool_length"] = project::tool_length_text(project.tool, plan.cutting_setup->machine);
    json["strategy"] = project::row_of(project::strategies(), project.toolpath.strategy).id;
    json["grid"] = row_of(program_grid(project)).id;
    json["error_mm"]["max"] = project::rounded(evaluation.closest.max);
    json["error_mm"]["mean"] = project::rounded(evaluation.closest.mean);
    json["error_mm"]["p95"] = project::rounded(evaluation.closest.p95);
    json["axis_deviation_deg"]["max"] = project::rounded(to_degrees(evaluation.closest.axis_max));
    json["axis_deviation_deg"]["mean"] = project::rounded(to_degrees(evaluation.closest.axis_mean));
    json["scallop_mm"]["wanted"] = project::rounded(project.tool.scallop_mm);
    json["scallop_mm"]["max"] = project::rounded(study.scallops.max);
    json["scallop_mm"]["mean"] = project::rounded(study.scallops.mean);
    json["scallop_mm"]["p95"] = project::rounded(study.scallops.p95);
    json["scallop_mm"]["by_formula"] = project::rounded(study.scallops.by_formula);
    const std::string why = why_higher(project, plan);
    json["scallop_mm"]["why_higher"] = why.empty() ? Json() : Json(why);
    json["gouged_percent"] = project::rounded(100.0 * study.scallops.gouged);
    json["not_cut_percent"] = project::rounded(100.0 * study.scallops.not_cut);
    const std::optional<double> least = left_at_least(plan);
    json["left_where_not_cut_mm"] = least ? Json(project::rounded(*least)) : Json();
    json["step_over_mm"] = std::isfinite(study.step_over) ? Json(project::rounded(study.step_over)) : Json();
    json["checked"] = checked_text(project);
    json["deepest_cut_below_surface_mm"] = project::rounded(study.deepest);
    json["bites"] = bites(study);
    json["local_gouges"] = local_gouges_json(study);
    json["estimated_time_s"] = project::rounded(plan.trajectory->duration());
    return project::json_text(json);
}

} // namespace millwright::plan
