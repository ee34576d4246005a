// A context that draws into memory. Needs no DISPLAY: EGL without a surface, a framebuffer object of its own.
// Not beside a window on the same thread: there, a picture of a view is taken with a ViewTarget.
#pragma once

#include "ui/render/context.h"

#include <memory>

namespace millwright::render {

class OffscreenContext final : public Context {
public:
    /// Current on return. Throws Error if there is no EGL or no OpenGL 3.3, Defect if the size has no area.
    explicit OffscreenContext(const PixelSize& size, double content_scale = 1.0);
    OffscreenContext(const OffscreenContext&) = delete;
    OffscreenContext& operator=(const OffscreenContext&) = delete;
    ~OffscreenContext() override;

    [[nodiscard]] PixelSize framebuffer_size() const override;
    [[nodiscard]] double content_scale() const override;
    void make_current() override;
    void begin() override;
    [[nodiscard]] Picture read_back() override;
    void present() override;

    /// Drops what was drawn. Throws Defect if the size has no area.
    void resize(const PixelSize& size);

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

} // namespace millwright::render
