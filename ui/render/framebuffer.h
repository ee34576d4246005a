// Something to draw into: colour (RGBA8) and depth, with or without several samples per pixel.
#pragma once

#include "ui/render/gl_objects.h"
#include "ui/render/picture.h"
#include "ui/render/pixel_size.h"

#include <optional>

namespace millwright::render {

/// What is worth its time: while things move, `rough` costs a third where the processor draws.
enum class Edges {
    smooth, ///< all samples of the framebuffer
    rough   ///< one sample per pixel
};

class Framebuffer {
public:
    /// `samples` is lowered to what the driver can do. Throws Defect if the size has no area or is refused.
    explicit Framebuffer(const PixelSize& size, int samples = 1);

    [[nodiscard]] const PixelSize& size() const { return size_; }
    [[nodiscard]] int samples() const { return samples_; }

    /// Drawing goes here, the viewport covers all of it.
    void bind(Edges edges = Edges::smooth) const;

    /// Brings the samples of each pixel together. To be called after drawing with smooth edges, before
    /// texture() or read().
    void resolve() const;

    /// The resolved colours, bottom row first.
    [[nodiscard]] GlId texture() const { return color_.id(); }

    /// The resolved colours, top row first.
    [[nodiscard]] Picture read() const;

private:
    PixelSize size_;
    int samples_ = 1;
    Texture color_;
    GlHandle<FramebufferKind> resolved_;
    GlHandle<RenderbufferKind> depth_;
    GlHandle<RenderbufferKind> sampled_depth_;
    GlHandle<RenderbufferKind> sampled_color_;
    GlHandle<FramebufferKind> sampled_;
};

// A 3D view as a picture of its own, with several samples per pixel, to be shown as an image inside a pane
// (which clips it) or read back.

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
