#include "ui/render/framebuffer.h"

#include "core/base/error.h"
#include "ui/render/internal/gl.h"

#include <algorithm>

namespace millwright::render {

namespace {

GlHandle<FramebufferKind> new_framebuffer() {
    GLuint id = 0;
    glGenFramebuffers(1, &id);
    return GlHandle<FramebufferKind>(id);
}

GlHandle<RenderbufferKind> new_renderbuffer(GLenum format, const PixelSize& size, int samples) {
    GLuint id = 0;
    glGenRenderbuffers(1, &id);
    glBindRenderbuffer(GL_RENDERBUFFER, id);
    const int asked = samples > 1 ? samples : 0;
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, asked, format, size.width, size.height);
    glBindRenderbuffer(GL_RENDERBUFFER, 0);
    return GlHandle<RenderbufferKind>(id);
}

void attach_depth(const GlHandle<RenderbufferKind>& depth) {
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER, depth.id());
}

void check_complete() {
    expects(glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE,
            "OpenGL accepts the framebuffer");
}

} // namespace

Framebuffer::Framebuffer(const PixelSize& size, int samples) : size_(size) {
    expects(size.width > 0 && size.height > 0, "a framebuffer has an area");
    const KeepFramebuffers keep;
    samples_ = std::clamp(samples, 1, std::max(gl_integer(GL_MAX_SAMPLES), 1));
    color_ = Texture(size, {}, Filter::linear);
    depth_ = new_renderbuffer(GL_DEPTH24_STENCIL8, size, 1);
    resolved_ = new_framebuffer();
    glBindFramebuffer(GL_FRAMEBUFFER, resolved_.id());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color_.id(), 0);
    attach_depth(depth_);
    check_complete();
    if (samples_ > 1) {
        sampled_depth_ = new_renderbuffer(GL_DEPTH24_STENCIL8, size, samples_);
        sampled_color_ = new_renderbuffer(GL_RGBA8, size, samples_);
        sampled_ = new_framebuffer();
        glBindFramebuffer(GL_FRAMEBUFFER, sampled_.id());
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, sampled_color_.id());
        attach_depth(sampled_depth_);
        check_complete();
    }
}

void Framebuffer::bind(Edges edges) const {
    const bool sampled = samples_ > 1 && edges == Edges::smooth;
    glBindFramebuffer(GL_FRAMEBUFFER, sampled ? sampled_.id() : resolved_.id());
    cover(size_);
}

void Framebuffer::resolve() const {
    if (samples_ == 1) {
        return;
    }
    const KeepFramebuffers keep;
    const auto [width, height] = size_;
    glDisable(GL_SCISSOR_TEST);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, sampled_.id());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_.id());
    glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

Picture Framebuffer::read() const {
    const KeepFramebuffers keep;
    glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved_.id());
    return read_pixels(size_, Alpha::kept);
}

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
