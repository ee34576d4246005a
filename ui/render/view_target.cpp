#include "ui/render/view_target.h"

#include "core/base/error.h"
#include "ui/render/internal/gl.h"

#include <algorithm>

namespace millwright::render {

ViewTarget::ViewTarget(int samples) : samples_(samples) {}

void ViewTarget::begin(const PixelSize& size, Edges edges) {
    const PixelSize wanted = {.width = std::max(size.width, 1), .height = std::max(size.height, 1)};
    std::array<GLint, 4> viewport{};
    glGetIntegerv(GL_VIEWPORT, viewport.data());
    viewport_before_ = {.width = viewport[2], .height = viewport[3]};
    bound_before_ = gl_name(GL_DRAW_FRAMEBUFFER_BINDING);
    if (!picture_ || picture_->size() != wanted) {
        picture_.emplace(wanted, samples_);
    }
    edges_ = edges;
    picture_->bind(edges);
}

void ViewTarget::end() {
    expects(picture_.has_value(), "drawing of a view starts before it ends");
    if (edges_ == Edges::smooth) {
        picture_->resolve();
    }
    glBindFramebuffer(GL_FRAMEBUFFER, bound_before_);
    cover(viewport_before_);
}

PixelSize ViewTarget::size() const {
    return picture_ ? picture_->size() : PixelSize{};
}

GlId ViewTarget::texture() const {
    return picture_ ? picture_->texture() : 0U;
}

Picture ViewTarget::read() const {
    expects(picture_.has_value(), "a view was drawn before it is read");
    return picture_->read();
}

} // namespace millwright::render
