// For tests of drawing: a context without display, a painter, and a scene that is measured in pixels.
#pragma once

#include "ui/render/framebuffer.h"
#include "ui/render/offscreen_context.h"
#include "ui/render/painter.h"

#include <glm/ext/matrix_clip_space.hpp>

#include <functional>

namespace millwright::render {

class Canvas {
public:
    explicit Canvas(const PixelSize& size, int samples = 1) : context_(size), size_(size), target_(samples) {}

    /// Scene x to the right and y downwards in pixels, larger z nearer.
    [[nodiscard]] View flat() const {
        const double width = size_.width;
        const double height = size_.height;
        // Eye coordinates have y upwards, so the scene is turned over.
        const glm::dmat4 upright(
            {1.0, 0.0, 0.0, 0.0}, {0.0, -1.0, 0.0, 0.0}, {0.0, 0.0, 1.0, 0.0}, {0.0, height, 0.0, 1.0});
        return {
            .view = upright, .projection = glm::ortho(0.0, width, 0.0, height, -100.0, 100.0), .size = size_};
    }

    /// What `draw` draws on the ground of `ground()`.
    [[nodiscard]] Picture picture(const std::function<void(const Painter&)>& draw) {
        target_.begin(size_);
        painter_.background(ground());
        draw(painter_);
        target_.end();
        return target_.read();
    }

    /// Plain dark grey.
    [[nodiscard]] static ViewColors ground() {
        ViewColors colors = view_colors(Theme::dark);
        colors.background_top = colors.background_bottom = glm::vec3(51.0F / 255.0F);
        return colors;
    }
    static constexpr Pixel ground_pixel = {51, 51, 51, 255};

private:
    OffscreenContext context_;
    PixelSize size_;
    Painter painter_;
    ViewTarget target_;
};

inline constexpr Pixel red_pixel = {255, 0, 0, 255};
inline const glm::vec4 red{1.0F, 0.0F, 0.0F, 1.0F};

} // namespace millwright::render
