#include "ui/design_panels/import_panel.h"

#include "core/base/numbers.h"
#include "core/base/sentences.h"
#include "core/base/text.h"
#include "core/exchange/patch_fit.h"
#include "ui/actions/app_controller.h"
#include "ui/panels/fields.h"
#include "ui/panels/numbers_text.h"
#include "ui/widgets/notices.h"
#include "ui/widgets/table.h"
#include "ui/workspaces/pending_import.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace millwright::panels {

namespace {

using exchange::CadFace;
using plan::ImportResult;
using project::ImportChoice;
using widgets::Option;

void choose_import(ActionQueue& ask, const ImportChoice& choice) {
    ask.files([choice](actions::AppController& app) { app.import().choose(choice); });
}

std::string size_text(const Vec3& size) {
    constexpr double large = 100.0; // mm: from here on without decimals
    const int decimals = size.maxCoeff() < large ? 1 : 0;
    return fmt::format(
        "{} x {} x {}", fixed(size.x(), decimals), fixed(size.y(), decimals), fixed(size.z(), decimals));
}

std::string degree_text(const CadFace& face) {
    int u = 0;
    int v = 0;
    for (const geometry::BezierPatch& patch : face.patches) {
        u = std::max(u, patch.degree_u());
        v = std::max(v, patch.degree_v());
    }
    return fmt::format("{} x {}", u, v);
}

std::string trim_text(const CadFace& face) {
    return !face.trimmed() ? ""
           : face.holes.empty()
               ? "trimmed"
               : fmt::format("{} {}", face.holes.size(), face.holes.size() == 1 ? "hole" : "holes");
}

void draw_faces(Ui& ui, ActionQueue& ask, const exchange::CadModel& model, const ImportChoice& choice) {
    const auto section = ui.section("faces", fmt::format("Faces: {}", model.faces.size()));
    if (!section) {
        return;
    }
    constexpr std::array<widgets::Column, 4> columns{{{"#", "", 0.8F, true},
                                                      {"Size", "mm", 2.2F, true},
                                                      {"Degree", "", 0.95F, true},
                                                      {"Outline", "", 1.15F, false}}};
    constexpr float row_px = 26.0F;
    constexpr float most_px = 330.0F;
    widgets::TableView view;
    view.columns = columns;
    view.rows = std::ssize(model.faces);
    view.cell = [&](std::ptrdiff_t row, int column) {
        const CadFace& face = model.faces[static_cast<std::size_t>(row)];
        return column == 0   ? std::to_string(face.number)
               : column == 1 ? size_text(face.box.sizes())
               : column == 2 ? degree_text(face)
                             : trim_text(face);
    };
    view.row_id = [&](std::ptrdiff_t row) {
        return std::to_string(model.faces[static_cast<std::size_t>(row)].number);
    };
    const std::vector<int> chosen = project::chosen_faces(model, choice);
    const auto is_chosen = [&](const CadFace& face) { return std::ranges::count(chosen, face.number) > 0; };
    const auto found = std::ranges::find_if(model.faces, is_chosen);
    view.chosen = found == model.faces.end() ? -1 : found - model.faces.begin();
    view.is_chosen = [&](std::ptrdiff_t row) {
        return is_chosen(model.faces[static_cast<std::size_t>(row)]);
    };
    view.height = std::min(ui.px(row_px) * static_cast<float>(view.rows + 1) + ui.px(8.0F), ui.px(most_px));
    if (const auto row = widgets::table(ui, "list", view)) {
        choose_import(ask, project::with_face(choice, model.faces[static_cast<std::size_t>(*row)].number));
    }
    for (const std::string& reason : model.left_out) {
        ui.note("Not imported: " + reason);
    }
}

void draw_unit(Ui& ui, ActionQueue& ask, const ImportChoice& choice) {
    struct Unit {
        Option option;
        double mm;
    };
    const std::array<Unit, 4> units{{{{"mm", "mm", {}, "", {}}, 1.0},
                                     {{"cm", "cm", {}, "", {}}, 10.0},
                                     {{"m", "m", {}, "", {}}, 1000.0},
                                     {{"inch", "inch", {}, "", {}}, 25.4}}};
    std::vector<Option> options;
    int index = 0;
    for (std::size_t n = 0; n < units.size(); ++n) {
        options.push_back(units[n].option);
        index = exactly_equal(units[n].mm, choice.mm_per_unit) ? static_cast<int>(n) : index;
    }
    if (const auto chosen = ui.segmented(
            "unit", "Unit", index, options, "Length unit; mesh and point files do not specify it")) {
        ImportChoice changed = choice;
        changed.mm_per_unit = units[static_cast<std::size_t>(*chosen)].mm;
        choose_import(ask, changed);
    }
}

void draw_side(Ui& ui, ActionQueue& ask, const ImportChoice& choice) {
    const std::array<Option, 7> options{
        {{"found", "Automatic", {}, "Direction of the mean normal, or +z for a closed mesh", {}},
         {"up", "+z", {}, "", {}},
         {"down", "-z", {}, "", {}},
         {"right", "+x", {}, "", {}},
         {"left", "-x", {}, "", {}},
         {"back", "+y", {}, "", {}},
         {"front", "-y", {}, "", {}}}};
    const std::array<Vec3, 7> sides{
        Vec3::Zero(), {0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
    const auto now = std::ranges::find(sides, choice.along.value_or(Vec3::Zero()));
    const auto index = static_cast<int>(now - sides.begin());
    if (const auto chosen = ui.choice("along", "Side", index, options, "Side of the mesh to fit")) {
        ImportChoice changed = choice;
        changed.along.reset();
        if (*chosen > 0) {
            changed.along = sides[static_cast<std::size_t>(*chosen)];
        }
        choose_import(ask, changed);
    }
}

void draw_degrees(Ui& ui, ActionQueue& ask, const ImportChoice& choice, const project::FitDegrees& degrees) {
    const auto field = [&](const char* id, const char* label, int project::FitDegrees::*which) {
        const widgets::FieldInfo info{
            id, label, "", "Degree of the fitted Bezier patch", 1.0, exchange::max_fit_degree, 5.0, 0};
        if (const auto value = ui.integer(degrees.*which, info)) {
            ImportChoice changed = choice;
            changed.degrees = degrees;
            (*changed.degrees).*which = *value;
            choose_import(ask, changed);
        }
    };
    field("degree_u", "Degree along u", &project::FitDegrees::u);
    field("degree_v", "Degree along v", &project::FitDegrees::v);
}

void draw_cloud(Ui& ui, ActionQueue& ask, const ImportChoice& choice) {
    if (const auto cloud =
            ui.toggle("cloud",
                      "Fit point cloud",
                      choice.cloud,
                      "Fit a smooth patch near the points instead of a surface through the rows of points")) {
        ImportChoice changed = choice;
        changed.cloud = *cloud;
        choose_import(ask, changed);
    }
}

/// Meshes are always fitted by one.
void draw_one_patch(Ui& ui, ActionQueue& ask, const ImportChoice& choice) {
    if (const auto fit =
            ui.toggle("fit",
                      "Fit single patch",
                      choice.degrees.has_value(),
                      "Fit one patch to the whole surface instead of using the original patches")) {
        ImportChoice changed = choice;
        changed.degrees = *fit ? std::optional(project::FitDegrees{}) : std::nullopt;
        choose_import(ask, changed);
    }
}

void draw_exact(Ui& ui, ActionQueue& ask, const ImportChoice& choice) {
    if (const auto exact =
            ui.toggle("exact",
                      "Exact face",
                      choice.exact,
                      "Use a face of several patches as one exact surface and machine all of it")) {
        ImportChoice changed = choice;
        changed.exact = *exact;
        choose_import(ask, changed);
    }
}

/// From then on faces are added and taken out by pointing at them.
void draw_join(Ui& ui, ActionQueue& ask, const exchange::CadModel& model, const ImportChoice& choice) {
    const std::vector<int> chosen = project::chosen_faces(model, choice);
    const auto none = widgets::Permission::refused("Select the first face.");
    if (const auto join =
            ui.toggle("join",
                      "Join faces",
                      !choice.joined.empty(),
                      "Machine several adjacent faces as one exact surface: click a face to add "
                      "or remove it",
                      chosen.empty() ? none : widgets::Permission{})) {
        ImportChoice changed = choice;
        changed.joined = *join ? chosen : std::vector<int>{};
        changed.face = chosen.front();
        changed.exact = changed.exact || *join;
        changed.degrees = *join ? std::nullopt : changed.degrees;
        choose_import(ask, changed);
    }
}

void draw_choice(Ui& ui, ActionQueue& ask, const project::ImportSource& source, const ImportChoice& choice) {
    const auto section = ui.section("patch", "Patch");
    if (!section) {
        return;
    }
    if (source.mesh || source.points) {
        draw_unit(ui, ask, choice);
        draw_side(ui, ask, choice);
    }
    if (source.points) {
        draw_cloud(ui, ask, choice);
    }
    if (source.model && source.model->faces.size() > 1) {
        draw_join(ui, ask, *source.model, choice);
    }
    if (!choice.joined.empty()) {
        return;
    }
    if (!source.mesh) {
        draw_one_patch(ui, ask, choice);
    }
    if (source.model && !choice.degrees) {
        draw_exact(ui, ask, choice);
    }
    if (source.mesh || choice.degrees) {
        draw_degrees(ui, ask, choice, choice.degrees.value_or(project::FitDegrees{}));
    }
}

void draw_points_off(Ui& ui, const project::PointFit& points, const char* numbered) {
    ui.value("rows",
             "Points",
             points.rows > 0 ? fmt::format("{} x {}", points.rows, points.columns)
                             : fmt::format("{} (cloud)", points.points.size()));
    ui.value(
        "max",
        "Largest deviation",
        deviation_text(points.deviation.max),
        "mm",
        fmt::format("Largest distance of a point from the surface ({} {})", numbered, points.worst_line()));
    ui.value("mean", "Mean deviation", deviation_text(points.deviation.mean), "mm");
    ui.value("rms", "RMS deviation", deviation_text(points.deviation.rms), "mm");
}

void draw_found(Ui& ui, const ImportResult& found) {
    const auto section = ui.section("result", "Result");
    if (!section) {
        return;
    }
    if (found.failure) {
        (void)widgets::banner(
            ui, "failure", {widgets::Severity::warning, found.failure->message, found.failure->hint});
        return;
    }
    if (!found.surface) {
        ui.note("Select a face: click it in the view or in the list.");
        return;
    }
    const project::SurfaceInput& surface = found.surface->surface;
    const std::size_t exact = surface.exact_faces().size();
    ui.value("patches",
             "Patches",
             exact == 0   ? std::to_string(surface.patches.size())
             : exact == 1 ? std::string("1 exact face")
                          : fmt::format("{} exact faces, joined", exact));
    if (const auto& joined = found.surface->joined) {
        ui.value("distortion",
                 "Distortion",
                 fixed(joined->flattening.distortion, 3),
                 "",
                 "Symmetric Dirichlet energy of the mapping to the square of u and v; 1 means none");
    }
    if (const auto& points = found.surface->points) {
        draw_points_off(ui, *points, found.source->mesh ? "point" : "point in line");
    } else if (const auto& fit = found.surface->fit) {
        ui.value("max",
                 "Largest deviation",
                 deviation_text(fit->deviation.max),
                 "mm",
                 "Largest distance from a point of the mesh or face to the patch");
        ui.value("patch_max",
                 "Largest, reverse",
                 deviation_text(fit->deviation.patch_max),
                 "mm",
                 "Largest distance from a point of the patch to the mesh or face");
        ui.value("mean", "Mean deviation", deviation_text(fit->deviation.mean), "mm");
        ui.value("rms", "RMS deviation", deviation_text(fit->deviation.rms), "mm");
    }
    for (const std::string& note : found.surface->notes) {
        ui.note(with_full_stop(note));
    }
    std::string warnings;
    for (const std::string& warning : found.surface->warnings) {
        warnings = with_sentence(std::move(warnings), as_sentence(warning));
    }
    if (!warnings.empty()) {
        (void)widgets::banner(ui, "warnings", {widgets::Severity::warning, warnings, {}});
    }
}

void draw_file(Ui& ui, const ImportResult& found) {
    const auto section = ui.section("file", "Import");
    if (!section) {
        return;
    }
    ui.value("name", "File", found.file.filename().string());
    const project::ImportSource& source = *found.source;
    if (source.model) {
        ui.value("unit", "File unit", source.model->unit.empty() ? "mm" : source.model->unit);
        return;
    }
    if (source.points) {
        ui.value("points", "Points", std::to_string(source.points->points.size()));
        return;
    }
    ui.value("triangles", "Triangles", std::to_string(source.mesh->mesh.triangles.size()));
    Box3 box;
    for (const Vec3& point : found.reference->fitted.points) {
        box.extend(point);
    }
    if (!box.isEmpty()) {
        ui.value("size", "Fitted side", size_text(box.sizes()), "mm");
    }
}

} // namespace

void import_panel(Ui& ui, const FrameState& now, ActionQueue& ask, const actions::Catalogue& catalogue) {
    const auto scope = ui.scope("import");
    const auto found = now.import.latest();
    if (found && found->source) {
        draw_file(ui, *found);
        if (found->source->model) {
            draw_faces(ui, ask, *found->source->model, now.import.choice());
        }
        draw_choice(ui, ask, *found->source, now.import.choice());
        draw_found(ui, *found);
    } else {
        ui.heading("Import");
        ui.value("name", "File", now.import.file().filename().string());
    }
    ui.gap();
    if (now.activity.busy && now.import.activity().busy) { // shown as in the status bar
        if (ui.progress("work", now.activity.text, now.activity.fraction)) {
            ask.run("work.cancel");
        }
        ui.gap();
    }
    if (!found) { // reading can be cancelled, nothing else
        return;
    }
    const auto row = ui.row(2);
    action_button(ui, now, ask, catalogue, "import.give_up");
    action_button(ui, now, ask, catalogue, "import.take", widgets::Rank::primary);
}

} // namespace millwright::panels
