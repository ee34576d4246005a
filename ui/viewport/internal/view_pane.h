// One picture of the view: its cameras, what it was last drawn from, and what is laid over it.
#pragma once

#include "ui/render/camera.h"
#include "ui/render/framebuffer.h"
#include "ui/viewport/internal/overlay.h"
#include "ui/viewport/mouse_tool.h"

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace millwright::viewport {

/// What all pictures share in a frame.
struct Frame3D {
    widgets::Ui& ui;
    const Scene& scene;
    const SceneView& view;
    const SurfacePicker& picker;
    render::ViewColors colors;
    bool details = true; ///< with axes, buttons and scale bar
    int buttons = 0;     ///< below the axes
    bool legends = true; ///< with these, too
    const SceneView* also =
        nullptr; ///< seen by the same camera in another picture: fitted into this one, too
};

/// For each Scene::sight, and in it for each of the scene's frames - workpiece, machine, arm - a picture
/// keeps a camera of its own.
class ViewPane {
public:
    ViewPane(std::string id, std::string caption, render::StandardView side, render::Projection projection);

    /// From now on the camera is that of this scene.
    void look_at(const Scene& scene);
    /// Draws into `place` and lets the mouse work. Records its handles if it is `active`.
    [[nodiscard]] std::vector<ViewEvent> draw(const Frame3D& frame, const widgets::Rect& place);

    [[nodiscard]] const std::string& id() const { return id_; }
    [[nodiscard]] const render::Camera& camera() const { return sight().camera; }
    void set_camera(const render::Camera& camera);
    void set_caption(std::string caption) { caption_ = std::move(caption); }
    /// Takes in everything at the next draw().
    void fit() { sight().fitted = false; }
    /// The same of every camera, or of those alone that have not been turned since they were fitted.
    void fit_all();
    void fit_unturned();

    [[nodiscard]] const MouseTool& mouse_tool() const { return mouse_tool_; }
    /// The mouse is in it or works in it.
    [[nodiscard]] bool in_use() const { return in_use_; }

private:
    struct Sight {
        render::Camera camera;
        bool fitted = false;
        /// While it is there, it makes room for legends that come.
        std::optional<render::CameraPose> fitted_pose = std::nullopt;
        float left_out = 0.0F; ///< of the picture at its left, pixels
        float below_out = 0.0F;
        widgets::Point fitted_size = {}; ///< of the picture that it was fitted into, pixels
    };
    /// Which camera.
    struct SightKey {
        int sight = 0;
        int frame = 0; ///< 0 workpiece, 1 machine, 2 arm

        friend auto operator<=>(const SightKey&, const SightKey&) = default;
    };
    /// All that the picture depends on.
    struct Drawn {
        Scene scene;
        render::CameraPose camera;
        render::PixelSize size;
        render::Theme theme = render::Theme::dark;
        Highlight highlight;

        friend bool operator==(const Drawn&, const Drawn&) = default;
    };

    [[nodiscard]] Sight& sight() { return sights_.at(at_); }
    [[nodiscard]] const Sight& sight() const { return sights_.at(at_); }
    void fit_if_needed(const Frame3D& frame, const widgets::Rect& place);
    void fit_into(const Frame3D& frame, const widgets::Rect& place, const widgets::Rect& free);
    void take_keys(const widgets::Ui& ui, const widgets::Pointer& pointer);
    [[nodiscard]] render::View view_of(const Frame3D& frame, const render::PixelSize& size) const;
    void draw_picture(const Frame3D& frame, const render::View& view, const widgets::Pointer& pointer);
    void paint(const Frame3D& frame, const render::View& view, render::Edges edges);
    [[nodiscard]] std::vector<widgets::Rect> taken_places(const Frame3D& frame, const Pane& pane) const;
    void draw_over(const Frame3D& frame, const Pane& pane);
    void record_handles(const Frame3D& frame, const Pane& pane) const;
    void record_arm(const Frame3D& frame, const Pane& pane) const;

    std::string id_;
    std::string caption_;
    render::Camera first_; ///< as each of them begins
    std::map<SightKey, Sight> sights_;
    SightKey at_;
    render::ViewTarget target_;
    std::optional<Drawn> drawn_;
    render::Edges edges_ = render::Edges::smooth; ///< of what was drawn
    bool changes_ = false;                        ///< the picture was another one in the last frame, too
    double wheel_until_ = 0.0;                    ///< ImGui time until which the wheel counts as turning
    MouseTool mouse_tool_;
    bool in_use_ = false;
};

} // namespace millwright::viewport
