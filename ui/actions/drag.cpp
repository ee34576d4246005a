#include "ui/actions/drag.h"

#include "core/base/error.h"
#include "ui/actions/app_controller.h"
#include "ui/workspaces/arm_workspace.h"

#include <utility>

namespace millwright::actions {

void Drag::begin(std::string name, DragEnds ends) {
    commit();
    name_ = std::move(name);
    ends_ = std::move(ends);
}

void Drag::update(const std::function<void()>& change) {
    expects(going_on(), "something is being dragged");
    change();
}

void Drag::commit() {
    const DragEnds ends = std::exchange(ends_, {});
    name_.reset();
    if (ends.commit) {
        ends.commit();
    }
}

void Drag::revert() {
    const DragEnds ends = std::exchange(ends_, {});
    name_.reset();
    if (ends.revert) {
        ends.revert();
    }
}

Dragged dragged_in_project(std::string title, std::function<void(project::Project&)> change) {
    const std::string key = "drag: " + title;
    return {.name = key,
            .begin = [key](AppController& app) -> DragEnds {
                app.end_step(); // of an earlier drag of the same
                return {.commit = [&app] { app.end_step(); },
                        .revert = [&app, key] { app.revert_step(key); }};
            },
            .update = [key, title = std::move(title), change = std::move(change)](
                          AppController& app) { app.edit(title, change, key); }};
}

Dragged dragged_on_arm(std::function<void(ArmWorkspace&)> change) {
    return {.name = "arm",
            .begin = [](AppController& app) -> DragEnds {
                const auto revert = [&app, before = app.arm().joints()] { app.arm().set_joints(before); };
                return {.commit = {}, .revert = revert};
            },
            .update = [change = std::move(change)](AppController& app) { change(app.arm()); }};
}

Dragged dragged_in_outline(std::function<void(std::vector<Vec2>&)> change) {
    return {.name = "outline",
            .begin = [](AppController& app) -> DragEnds {
                const auto revert = [&app, before = app.view_state().surface_tool.draft] {
                    app.view_state().surface_tool.draft = before;
                };
                return {.commit = {}, .revert = revert};
            },
            .update = [change = std::move(change)](
                          AppController& app) { change(app.view_state().surface_tool.draft); }};
}

void follow(Drag& drag, AppController& app, viewport::DragStage stage, const Dragged& what) {
    if (stage == viewport::DragStage::finished) {
        drag.commit();
    } else if (stage == viewport::DragStage::cancelled) {
        drag.revert();
    } else {
        if (!drag.is(what.name)) {
            drag.begin(what.name, what.begin(app));
        }
        drag.update([&] { what.update(app); });
    }
}

} // namespace millwright::actions
