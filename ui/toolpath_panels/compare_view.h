// Two results beside each other: which one is the other, and its scene.
#pragma once

#include "ui/panels/panel.h"
#include "ui/viewport/scene.h"

#include <memory>
#include <optional>
#include <string>

namespace millwright::panels {

/// The choice of what stands beside the shown result, and the button that keeps one.
void compare_fields(Ui& ui, const FrameState& now, ActionQueue& ask, const actions::Catalogue& catalogue);

/// The path that stands beside the shown one, in the Toolpath workspace alone, with a name in one line.
struct ComparedPath {
    std::shared_ptr<const plan::Evaluation> path; ///< never null
    std::string name;
};
/// Nothing where there is none, or not yet.
[[nodiscard]] std::optional<ComparedPath> path_to_compare(const FrameState& now);

/// A result under its name.
struct NamedScene {
    viewport::Scene scene;
    std::string name;
};

/// What stands beside `shown`, in the Toolpath workspace alone; nothing where there is none, or not yet. Both
/// paths get the same colours for the same error.
[[nodiscard]] std::optional<NamedScene> compared_scene(const FrameState& now, viewport::Scene& shown);

/// The name of the shown result: as much of it as may differ from what stands beside it.
[[nodiscard]] std::string shown_name_in_comparison(const FrameState& now);

} // namespace millwright::panels
