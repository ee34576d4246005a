#include "ui/viewport/internal/view_notes.h"

#include "core/base/sentences.h"
#include "core/toolpath/actual_trajectory.h"
#include "ui/viewport/internal/grid_lines.h"

namespace millwright::viewport {

std::string produced_note(const Scene& scene) {
    return scene.layers.design.produced && scene.shown
               ? with_full_stop(toolpath::why_no_produced_surface(scene.shown->toolpath))
               : std::string();
}

std::string view_notes(const Scene& scene, const render::View& view) {
    std::string notes = grid_lines_note(scene, view);
    if (const std::string produced = produced_note(scene); !produced.empty()) {
        notes += (notes.empty() ? "" : "\n") + produced;
    }
    return notes;
}

} // namespace millwright::viewport
