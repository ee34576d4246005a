// What the left button does on the surface with a tool: a brush paints along its way, an outline gets
// corners by clicks, which can be dragged.
#pragma once

#include "ui/viewport/events.h"
#include "ui/viewport/picking.h"
#include "ui/widgets/canvas.h"

#include <optional>
#include <vector>

namespace millwright::viewport {

/// One frame of one picture.
struct SurfaceMouseToolInput {
    const Scene& scene; ///< with a surface and a tool in hand
    const render::View& view;
    const widgets::Pointer& pointer;
    std::optional<SurfaceHit> hit; ///< under the mouse
    bool take_back = false;        ///< Esc went down
};

class SurfaceMouseTool {
public:
    [[nodiscard]] std::vector<ViewEvent> follow(const SurfaceMouseToolInput& input);

    /// Where the tool is on the patch that is machined; nothing beside it.
    [[nodiscard]] const std::optional<Vec2>& at() const { return at_; }
    /// The corner of the outline under the mouse, or that is dragged.
    [[nodiscard]] std::optional<int> corner() const { return corner_; }
    /// A stroke or a drag is going on.
    [[nodiscard]] bool works() const { return last_ || dragging_; }
    void leave();

private:
    void paint(const SurfaceMouseToolInput& input, std::vector<ViewEvent>& events);
    void draw_outline(const SurfaceMouseToolInput& input, std::vector<ViewEvent>& events);
    void press_outline(const SurfaceMouseToolInput& input, std::vector<ViewEvent>& events);
    void finish(DragStage stage, std::vector<ViewEvent>& events);

    std::optional<Vec2> at_;
    std::optional<Vec2> last_; ///< of a stroke: where the brush dabbed last
    std::optional<int> corner_;
    bool dragging_ = false; ///< a corner
};

/// The corner of the scene's outline nearest to `pixel` and not further than `within_px`.
[[nodiscard]] std::optional<int>
pick_corner(const Scene& scene, const render::View& view, const glm::dvec2& pixel, double within_px);

/// Points on `patch` that are `radius` mm in space from the one at `uv`, once around it; where the patch ends
/// before, on its border.
[[nodiscard]] std::vector<Vec3>
ring_on(const geometry::ParametricSurface& patch, const Vec2& uv, double radius);

/// The outline on `patch`, corner after corner with places between them; back to the first if it is closed.
[[nodiscard]] std::vector<Vec3>
outline_on(const geometry::ParametricSurface& patch, const std::vector<Vec2>& corners, bool closed);

} // namespace millwright::viewport
