// Surfaces of other programs: bringing them in, and writing for them.
#include "ui/actions/app_controller.h"
#include "ui/actions/internal/simple_action.h"
#include "ui/workspaces/pending_import.h"

namespace millwright::actions {

namespace {

using widgets::Permission;

Permission is_importing(const FrameState& now) {
    return now.import.is_open() ? Permission{} : Permission::refused("No surface is being imported.");
}

Permission can_take(const FrameState& now) {
    if (const Permission open = is_importing(now); !open.allowed) {
        return open;
    }
    if (now.import.is_ready()) {
        return {};
    }
    if (now.import.activity().busy) {
        return Permission::refused("The surface is still being computed.");
    }
    const auto found = now.import.latest();
    return Permission::refused(found && found->failure ? "The surface cannot be imported with these settings."
                                                       : "Select a face first.");
}

Permission has_reference(const FrameState& now) {
    return !now.import.is_open() && now.import.reference(now.project.surface)
               ? Permission{}
               : Permission::refused("There is no reference mesh.");
}

} // namespace

void add_import_actions(Actions& actions) {
    add(actions,
        {"file.import",
         "File",
         "Import surface ...",
         "Imports a face of a STEP or IGES file, or fits a patch to an STL, OBJ or PLY mesh.",
         "Ctrl+I",
         ""},
        always,
        [](ActionContext& context) { context.view_state.file_prompt = FilePrompt::import_surface; });
    add(actions,
        {"file.export",
         "File",
         "Export surface ...",
         "Writes the surface as STEP, glb, STL, OBJ or PLY; the file extension selects the format.",
         "",
         ""},
        always,
        [](ActionContext& context) { context.view_state.file_prompt = FilePrompt::export_surface; });
    add(actions,
        {"file.drop_reference",
         "File",
         "Remove the reference mesh",
         "Removes the triangles of the imported file from the view.",
         "",
         ""},
        has_reference,
        [](ActionContext& context) { context.app.import().drop_reference(); });
    add(actions,
        {"import.take", dialog_menu, "Import", "Replaces the project's surface; Undo restores it.", "", ""},
        can_take,
        [](ActionContext& context) { context.app.take_import(); });
    add(actions,
        {"import.give_up", dialog_menu, "Cancel", "The project is not changed.", "", ""},
        is_importing,
        [](ActionContext& context) {
            context.app.import().close();
            context.view_state.fit_wanted_in(Workspace::design) = true;
        });
}

} // namespace millwright::actions
