// The 3D view as a pane of the window: one picture or four, with cameras, words, legend, scale bar and axes,
// and what the mouse does in it. It only shows and asks: what a person did comes back as events (events.h).
//
// Mouse: middle or right button, or Alt and the left one: orbit; with Shift: pan. Wheel: zoom to the mouse.
// Left: click selects a control point (Ctrl: adds or takes away) or goes to a move of the path; dragging a
// control point moves all selected ones in the screen plane, with X, Y or Z held along that axis, with Shift
// ten times finer, with Ctrl to round coordinates; Esc takes it back. Dragging from an empty place selects by
// a box; a double click there fits. Keys while the mouse is in the view: F or Home fit, 1 front, 2 top, 3
// right, 4 back, 5 bottom, 6 left, 0 iso, P projection.
#pragma once

#include "ui/render/camera.h"
#include "ui/viewport/events.h"
#include "ui/widgets/ui.h"

#include <memory>
#include <string>
#include <vector>

namespace millwright::viewport {

enum class Arrangement { one, four };

/// Made once per context, after it and gone before it; a session of ImGui has to be there when drawing.
class Viewport {
public:
    Viewport();
    ~Viewport();
    Viewport(const Viewport&) = delete;
    Viewport& operator=(const Viewport&) = delete;

    /// Draws the scene into `place` of the current pane. A picture is drawn anew only if something in it
    /// changed. The first time, and after fit(), the camera takes in everything. Handles of control points
    /// are recorded as `control_point(i,j)` (of later patches `control_point(patch,i,j)`), within `top`,
    /// `front`, `right` and `iso` where there are four pictures.
    [[nodiscard]] std::vector<ViewEvent>
    draw(widgets::Ui& ui, const widgets::Rect& place, const Scene& scene);

    /// A scene with its name over it.
    struct Named {
        const Scene& scene;
        std::string caption;
    };
    /// Two scenes side by side, seen by one camera: what turns one turns the other. Events come from the
    /// right one alone; its handles are recorded within `right`, as is all of the other within `left`.
    [[nodiscard]] std::vector<ViewEvent>
    draw_two(widgets::Ui& ui, const widgets::Rect& place, const Named& left, const Named& right);

    /// From now on everything here is about the cameras of this scene: each Scene::sight has its own.
    void look_at(const Scene& scene);
    /// Takes in everything at the next draw().
    void fit();
    /// The same for every camera that has not been turned since it was fitted: there is more to be seen.
    void fit_unturned();
    /// Turns the picture last worked in.
    void look_from(render::StandardView side);
    void set_projection(render::Projection projection);
    void set_arrangement(Arrangement arrangement);

    [[nodiscard]] Arrangement arrangement() const;
    /// Of the picture last worked in.
    [[nodiscard]] const render::Camera& camera() const;
    void set_camera(const render::Camera& camera);

    /// As of the last draw(); for the status bar.
    [[nodiscard]] const UnderMouse& under_mouse() const;
    /// Upper left corner of one more button below those of the view, as of the last draw().
    [[nodiscard]] widgets::Point next_button() const;
    /// Control points are being dragged.
    [[nodiscard]] bool dragging() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace millwright::viewport
