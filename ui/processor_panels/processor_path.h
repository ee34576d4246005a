// The tool path that the processor computes: in 3D in step with it, and as a map of how far it is from the
// exact one.
#pragma once

#include "ui/panels/panel.h"
#include "ui/render/camera.h"

namespace millwright::panels {

class ProcessorPath {
public:
    /// What is passed already is coloured; a drag orbits, the wheel zooms.
    void draw(Ui& ui, const FrameState& now, const widgets::Rect& place);

private:
    render::Camera camera_{{.yaw = -1.35, .pitch = 0.75}};
    double zoom_ = 1.0;
};

/// The path in the plane, each set-point coloured by its distance from its exact place; late ones are marked.
void draw_difference_map(Ui& ui, const FrameState& now, const widgets::Rect& place);

} // namespace millwright::panels
