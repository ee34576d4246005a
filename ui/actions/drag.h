// What a person drags to change it: one change from its first move to the release of the button, which Esc
// takes back. One thing is dragged at a time.
#pragma once

#include "ui/viewport/events.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace millwright::project {
struct Project;
} // namespace millwright::project

namespace millwright::actions {

class AppController;
class ArmWorkspace;

/// How a drag ends, made when it begins.
struct DragEnds {
    std::function<void()> commit; ///< empty: there is nothing to do
    std::function<void()> revert; ///< puts back what was there
};

class Drag {
public:
    /// What is still being dragged is committed.
    void begin(std::string name, DragEnds ends);
    /// Only while going_on().
    void update(const std::function<void()>& change);
    /// Keeps what was changed; nothing unless going_on().
    void commit();
    /// Everything is as it was before begin(); nothing unless going_on().
    void revert();

    [[nodiscard]] bool going_on() const { return name_.has_value(); }
    [[nodiscard]] bool is(const std::string& name) const { return name_ == name; }

private:
    std::optional<std::string> name_;
    DragEnds ends_;
};

/// One frame of something that is dragged.
struct Dragged {
    std::string name; ///< another name is another drag
    std::function<DragEnds(AppController&)> begin;
    std::function<void(AppController&)> update;
};

/// A change of the project, which becomes one step of undo with that title.
[[nodiscard]] Dragged dragged_in_project(std::string title, std::function<void(project::Project&)> change);
/// A change of the drawn arm's pose.
[[nodiscard]] Dragged dragged_on_arm(std::function<void(ArmWorkspace&)> change);
/// A change of the outline that is being drawn.
[[nodiscard]] Dragged dragged_in_outline(std::function<void(std::vector<Vec2>&)> change);

/// Begins `what` with the first of its frames, updates it with each, and ends it as `stage` says.
void follow(Drag& drag, AppController& app, viewport::DragStage stage, const Dragged& what);

} // namespace millwright::actions
