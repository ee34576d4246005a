#include "ui/viewport/picture_facts.h"

#include "core/base/counted.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/plan/strategy_path.h"
#include "core/project/grid_methods/grid_method_row.h"

#include <cmath>

namespace millwright::viewport {

namespace {

using project::GridMethod;

std::string times(int a, int b) {
    return std::to_string(a) + " \u00D7 " + std::to_string(b);
}

/// Lengths to a micrometre, what is larger than a metre to a tenth of a millimetre.
std::string reachable_length_text(double length, int decimals) {
    return std::isfinite(length) ? fixed(length, std::abs(length) < 1000.0 ? decimals : 1) : "out of reach";
}

std::vector<std::string> error_row(std::string_view name, const plan::Evaluation& evaluation) {
    const grid::ErrorSummary& errors = evaluation.closest;
    return {std::string(name),
            reachable_length_text(errors.max, 3),
            reachable_length_text(errors.mean, 4),
            reachable_length_text(errors.lmean, 4),
            reachable_length_text(errors.p95, 4),
            reachable_length_text(to_degrees(errors.axis_max), 2),
            evaluation.track_gap ? reachable_length_text(*evaluation.track_gap, 2) : "-"};
}

void add_errors(PictureFacts& facts, const project::Project& project, const plan::Plan& plan) {
    facts.columns = {"error", "max mm", "mean mm", "by length mm", "95 % mm", "axis \u00B0", "track gap mm"};
    if (plan.grid(GridMethod::uniform).evaluation) {
        facts.rows.push_back(
            error_row(title(GridMethod::uniform), *plan.grid(GridMethod::uniform).evaluation));
    }
    const auto& chosen = plan.program_path(project);
    if (chosen && chosen != plan.grid(GridMethod::uniform).evaluation) {
        facts.rows.push_back(error_row(program_title(project), *chosen));
    }
}

void add_design(PictureFacts& facts, const plan::Plan& plan) {
    if (!plan.surface) {
        return;
    }
    const Vec3 size = plan.surface->control_box().sizes();
    const std::string lengths = reachable_length_text(size.x(), 1) + " \u00D7 " +
                                reachable_length_text(size.y(), 1) + " \u00D7 " +
                                reachable_length_text(size.z(), 1);
    const std::vector<geometry::BsplineSurface>& faces = plan.surface->faces();
    if (plan.joined) {
        facts.columns = {"design", "net size mm", "faces", "flattening", "distortion"};
        facts.rows.push_back({"joined faces",
                              lengths,
                              std::to_string(faces.size()),
                              std::string(region::name_of(plan.joined->flattening.method)),
                              fixed(plan.joined->flattening.distortion, 3)});
        return;
    }
    if (faces.size() > 1) { // they could not be joined
        return;
    }
    if (!faces.empty()) {
        const geometry::BsplineSurface& face = faces.front();
        const auto [u, v] = face.spans();
        facts.columns = {"design", "net size mm", "degree", "control points", "spans"};
        facts.rows.push_back({face.rational() ? "rational" : "polynomial",
                              lengths,
                              times(face.net().degree_u, face.net().degree_v),
                              times(face.net().rows, face.net().columns),
                              times(u, v)});
        return;
    }
    const geometry::BezierPatch& patch = plan.surface->patch(geometry::PatchId{0});
    facts.columns = {"design", "net size mm", "degree", "control points", "patches"};
    facts.rows.push_back({patch.rational() ? "rational" : "polynomial",
                          lengths,
                          times(patch.degree_u(), patch.degree_v()),
                          times(patch.net().rows, patch.net().columns),
                          std::to_string(plan.surface->patch_count())});
}

std::string subtitle(const project::Project& project, const plan::Plan& plan, ViewKind kind) {
    std::string text(title(kind));
    if (plan.cutting_setup) {
        text += "  \u00B7  " + plan.cutting_setup->machine.name();
    }
    if (kind != ViewKind::design) {
        text += "  \u00B7  " + times(project.grid.nu, project.grid.nv) + " nodes";
        text += "  \u00B7  " + counted(plan.singular_points.size(), "singular point");
    }
    return text;
}

} // namespace

std::string_view title(GridMethod method) {
    return row_of(method).caption;
}

std::string program_title(const project::Project& project) {
    return plan::has_own_path(project) ? plan::strategy_text(project)
                                       : std::string(title(plan::program_grid(project)));
}

PictureFacts picture_facts(const project::Project& project, const plan::Plan& plan, ViewKind kind) {
    PictureFacts facts;
    facts.title = project.name;
    facts.subtitle = subtitle(project, plan, kind);
    if (kind == ViewKind::design) {
        add_design(facts, plan);
    } else {
        add_errors(facts, project, plan);
    }
    return facts;
}

} // namespace millwright::viewport
