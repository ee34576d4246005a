// The part of AppController that deals with surfaces of other programs.
#include "core/base/error.h"
#include "core/base/sentences.h"
#include "core/exchange/surface_file.h"
#include "core/project/export_note.h"
#include "core/project/surface.h"
#include "ui/actions/app_controller.h"
#include "ui/workspaces/pending_import.h"
#include "ui/workspaces/surface_export.h"

namespace millwright::actions {

namespace fs = std::filesystem;

void AppController::open_surface(const fs::path& file) {
    if (!fs::is_regular_file(file)) {
        throw Error(fs::exists(file) ? "is not a file" : "there is no such file", file);
    }
    import_->open(fs::absolute(file).lexically_normal());
    view_state_.workspace = Workspace::design;
    view_state_.panes.inspector_shown = true; // what is to be chosen stands there
    view_state_.file_prompt = FilePrompt::none;
    remember(file);
}

/// The view is fitted to what comes; what is wrong with a file is reported once, and an unread one is given
/// up.
void AppController::follow_import() {
    if (const auto written = export_->take_news()) {
        if (written->failure) {
            tell(view_state_, widgets::Severity::danger, to_text(*written->failure));
        } else {
            tell(view_state_,
                 written->left_out.empty() ? widgets::Severity::good : widgets::Severity::info,
                 written->left_out.empty() ? "Surface written." : "Surface written. " + written->left_out,
                 written->file.string());
        }
    }
    const auto now = import_->latest();
    if (!now || now->revision == followed_import_) {
        return;
    }
    followed_import_ = now->revision;
    if (now->source !=
        fitted_import_.lock()) { // not where another face is chosen: a click would move what it hit
        fitted_import_ = now->source;
        view_state_.fit_wanted_in(Workspace::design) = true;
    }
    if (now->failure) {
        Diagnostic told = *now->failure;
        told.place.file = now->file.filename();
        tell(view_state_, widgets::Severity::danger, to_text(told));
    }
    if (!now->source) {
        import_->close();
    }
}

void AppController::take_import() {
    const std::string title = "Import " + import_->file().filename().string();
    const project::SurfaceInput before = history_.current().surface;
    const auto now = import_->latest();
    expects(import_->is_ready(), "there is a surface to be taken");
    edit(title, [&](project::Project& draft) { draft.surface = now->surface->surface; }, {});
    (void)import_->take(before); // only now: a surface that is refused stays pending
    for (const std::string& note : now->surface->notes) {
        tell(view_state_, widgets::Severity::info, with_full_stop(note), now->file.filename().string());
    }
    for (const std::string& warning : now->surface->warnings) {
        tell(view_state_, widgets::Severity::warning, as_sentence(warning), now->file.filename().string());
    }
    view_state_.selected.clear();
    fit_project(view_state_);
}

void AppController::export_surface(const fs::path& file) {
    if (!exchange::is_surface_file(file)) {
        throw Error("a surface cannot be written to this type of file",
                    file,
                    "use a name ending in .step, .glb, .stl, .obj or .ply");
    }
    export_->write(
        {std::make_shared<const geometry::Surface>(project::surface_of(history_.current().surface)),
         fs::absolute(file).lexically_normal(),
         project::left_out_text(history_.current().surface)});
    view_state_.file_prompt = FilePrompt::none;
}

} // namespace millwright::actions
