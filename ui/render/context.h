// An OpenGL 3.3 core context with something to draw into: a window, or memory without any display.
// One thread, the UI thread, makes it current and uses it. GL objects die before their context.
#pragma once

#include "ui/render/picture.h"
#include "ui/render/pixel_size.h"

namespace millwright::render {

class Context {
public:
    Context() = default;
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;
    virtual ~Context() = default;

    [[nodiscard]] virtual PixelSize framebuffer_size() const = 0;

    /// How many pixels make one pixel of a 96 dpi monitor: 1, 1.5, 2 ...
    [[nodiscard]] virtual double content_scale() const = 0;

    /// Further GL calls of this thread go to this context.
    virtual void make_current() = 0;

    /// Makes the context current and binds its own framebuffer, with the viewport over all of it.
    virtual void begin() = 0;

    /// What has been drawn since the last present(), top row first.
    [[nodiscard]] virtual Picture read_back() = 0;

    /// Shows what was drawn. Of a window, the picture to draw into is undefined afterwards.
    virtual void present() = 0;
};

} // namespace millwright::render
