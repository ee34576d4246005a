// What the left button does in one picture of the view: pointing, selecting, dragging, going to a move.
#pragma once

#include "ui/viewport/arm_mouse_tool.h"
#include "ui/viewport/picking.h"
#include "ui/viewport/point_drag.h"
#include "ui/viewport/scene_view.h"
#include "ui/viewport/surface_mouse_tool.h"
#include "ui/widgets/canvas.h"

#include <optional>
#include <vector>

namespace millwright::viewport {

/// One frame of one picture.
struct MouseToolInput {
    const Scene& scene;
    const render::View& view;
    const SurfacePicker& picker;
    widgets::Pointer pointer;
    DragKeys keys;
    bool take_back = false; ///< Esc went down
};

class MouseTool {
public:
    /// A rectangle between two pixels of the picture.
    struct Box {
        glm::dvec2 corner{};
        glm::dvec2 opposite{};
    };

    [[nodiscard]] std::vector<ViewEvent> follow(const MouseToolInput& input);

    [[nodiscard]] const Highlight& highlight() const { return highlight_; }
    [[nodiscard]] const UnderMouse& under_mouse() const { return under_mouse_; }
    [[nodiscard]] const std::optional<PointDrag>& drag() const { return drag_; }
    /// The box of a selection in the making.
    [[nodiscard]] const std::optional<Box>& box() const { return box_; }
    /// Of a tool on the surface.
    [[nodiscard]] const SurfaceMouseTool& surface() const { return surface_; }
    /// A double click on nothing in this frame.
    [[nodiscard]] bool wants_fit() const { return wants_fit_; }
    /// The button is down, or the mouse was last seen in the picture.
    [[nodiscard]] bool busy() const { return pressed_.has_value(); }
    /// The mouse left the picture.
    void leave();

private:
    struct Pressed {
        glm::dvec2 pixel{};
        std::optional<ControlPointId> point;
    };

    [[nodiscard]] std::vector<ViewEvent> follow_arm(const MouseToolInput& input);
    [[nodiscard]] std::vector<ViewEvent> follow_tool(const MouseToolInput& input);
    void point_at(const MouseToolInput& input);
    std::optional<double> point_at_solid(const MouseToolInput& input, const Frame& s_T_w);
    void press(const MouseToolInput& input);
    void hold(const MouseToolInput& input, std::vector<ViewEvent>& events);
    void release(const MouseToolInput& input, std::vector<ViewEvent>& events);
    void click(const MouseToolInput& input, std::vector<ViewEvent>& events) const;
    void begin_drag(const MouseToolInput& input, std::vector<ViewEvent>& events);
    void let_go(std::vector<ViewEvent>& events);
    void take_back(std::vector<ViewEvent>& events);

    Highlight highlight_;
    ArmMouseTool arm_;
    SurfaceMouseTool surface_;
    UnderMouse under_mouse_;
    std::optional<double> move_fraction_;
    std::optional<Pressed> pressed_;
    std::optional<PointDrag> drag_;
    std::optional<Box> box_;
    bool wants_fit_ = false;
};

} // namespace millwright::viewport
