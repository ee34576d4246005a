// A 3D view as a picture of its own, with several samples per pixel, to be shown as an image inside a pane
// (which clips it) or read back.
#pragma once

#include "ui/render/framebuffer.h"
#include "ui/render/picture.h"
#include "ui/render/pixel_size.h"

#include <optional>

namespace millwright::render {

class ViewTarget {
public:
    explicit ViewTarget(int samples = 4);

    /// Drawing goes here until end(). Memory is made anew only when the size changes; a size without area
    /// counts as one pixel.
    void begin(const PixelSize& size, Edges edges = Edges::smooth);

    /// The picture is ready. Drawing goes back to what was bound before begin().
    void end();

    /// Of the last picture; empty before the first.
    [[nodiscard]] PixelSize size() const;

    /// Of the last picture, bottom row first, 0 before the first. In a pane: imgui_compat.h, show().
    [[nodiscard]] GlId texture() const;

    /// The last picture. Throws Defect before the first.
    [[nodiscard]] Picture read() const;

private:
    int samples_;
    Edges edges_ = Edges::smooth; ///< of the picture that was begun
    std::optional<Framebuffer> picture_;
    GlId bound_before_ = 0U;
    PixelSize viewport_before_;
};

} // namespace millwright::render
