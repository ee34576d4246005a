// OpenGL's own header, and what every use of it needs: the answers of glGet, and the state that is put back.
#pragma once

#include "ui/render/picture.h"
#include "ui/render/pixel_size.h"

#include <epoxy/gl.h>

#include <array>
#include <optional>
#include <string>

namespace millwright::render {

[[nodiscard]] inline int gl_integer(GLenum what) {
    GLint value = 0;
    glGetIntegerv(what, &value);
    return value;
}

[[nodiscard]] inline GLuint gl_name(GLenum binding) {
    return static_cast<GLuint>(gl_integer(binding));
}

/// Remembers the bound framebuffers and binds them again at its end.
class KeepFramebuffers {
public:
    KeepFramebuffers()
        : draw_(gl_name(GL_DRAW_FRAMEBUFFER_BINDING)), read_(gl_name(GL_READ_FRAMEBUFFER_BINDING)) {}
    KeepFramebuffers(const KeepFramebuffers&) = delete;
    KeepFramebuffers& operator=(const KeepFramebuffers&) = delete;
    ~KeepFramebuffers() {
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, draw_);
        glBindFramebuffer(GL_READ_FRAMEBUFFER, read_);
    }

private:
    GLuint draw_;
    GLuint read_;
};

/// Later drawing covers the whole of a framebuffer of this size.
inline void cover(const PixelSize& size) {
    glViewport(0, 0, size.width, size.height);
    glDisable(GL_SCISSOR_TEST);
}

// What we ask of OpenGL.

inline constexpr int gl_major = 3;
inline constexpr int gl_minor = 3;

/// Of the current context: nothing if it will do, else the sentence why not.
[[nodiscard]] std::optional<std::string> too_old();

/// What a user can do when there is no OpenGL.
[[nodiscard]] std::string gl_hint();

// Pixels of the framebuffer that is bound for reading.

enum class Alpha { kept, opaque };

/// From the lower left corner of the framebuffer; the picture has its top row first.
[[nodiscard]] Picture read_pixels(const PixelSize& size, Alpha alpha);

} // namespace millwright::render
