// What the left button does to an arm in one picture of the view: it takes hold of the tip of the tool, which
// then follows the mouse as a control point does (point_drag.h), or of a link, which turns its joint.
#pragma once

#include "ui/viewport/arm_grip.h"
#include "ui/viewport/events.h"
#include "ui/viewport/point_drag.h"
#include "ui/widgets/canvas.h"

#include <optional>
#include <vector>

namespace millwright::viewport {

/// One frame of one picture.
struct ArmMouseToolInput {
    const ArmScene& scene;
    const render::View& view;
    const widgets::Pointer& pointer;
    DragKeys keys;
    bool take_back = false; ///< Esc went down
};

class ArmMouseTool {
public:
    [[nodiscard]] std::vector<ViewEvent> follow(const ArmMouseToolInput& input);

    /// What the mouse is on, or holds.
    [[nodiscard]] const std::optional<ArmGrip>& grip() const { return grip_; }
    [[nodiscard]] bool holds() const { return held_; }
    /// A double click on nothing in this frame.
    [[nodiscard]] bool wants_fit() const { return wants_fit_; }
    void leave();

private:
    void press(const ArmMouseToolInput& input);
    void hold(const ArmMouseToolInput& input, std::vector<ViewEvent>& events);
    void finish(DragStage stage, std::vector<ViewEvent>& events);

    std::optional<ArmGrip> grip_;
    bool held_ = false;
    bool moved_ = false; ///< since it was taken hold of
    bool wants_fit_ = false;
    glm::dvec2 pressed_{};
    Vec3 local_ = Vec3::Zero();     ///< of a link: where it is held, in its joint's frame
    std::optional<PointDrag> drag_; ///< of the tip
};

} // namespace millwright::viewport
