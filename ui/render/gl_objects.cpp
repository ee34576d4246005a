#include "ui/render/gl_objects.h"

#include "core/base/error.h"
#include "ui/render/internal/gl.h"

namespace millwright::render {

namespace {

// Buffers are made through this binding, so that no vertex array's indices are replaced by accident.
constexpr GLenum upload_target = GL_COPY_WRITE_BUFFER;

template <typename Make> GLuint made(Make make) {
    GLuint id = 0;
    make(1, &id);
    return id;
}

const void* byte_offset(std::ptrdiff_t offset) {
    // NOLINTNEXTLINE(performance-no-int-to-ptr): the interface of OpenGL
    return reinterpret_cast<const void*>(offset);
}

} // namespace

void BufferKind::remove(GlId id) noexcept {
    glDeleteBuffers(1, &id);
}
void VertexArrayKind::remove(GlId id) noexcept {
    glDeleteVertexArrays(1, &id);
}
void TextureKind::remove(GlId id) noexcept {
    glDeleteTextures(1, &id);
}
void RenderbufferKind::remove(GlId id) noexcept {
    glDeleteRenderbuffers(1, &id);
}
void FramebufferKind::remove(GlId id) noexcept {
    glDeleteFramebuffers(1, &id);
}
void ProgramKind::remove(GlId id) noexcept {
    glDeleteProgram(id);
}

Buffer::Buffer(std::span<const std::byte> bytes) : handle_(made(glGenBuffers)) {
    glBindBuffer(upload_target, id());
    glBufferData(upload_target, std::ssize(bytes), bytes.data(), GL_STATIC_DRAW);
    glBindBuffer(upload_target, 0);
}

VertexArray::VertexArray() : handle_(made(glGenVertexArrays)) {}

void VertexArray::attach(const Buffer& buffer, const Attribute& attribute) const {
    glBindVertexArray(id());
    glBindBuffer(GL_ARRAY_BUFFER, buffer.id());
    glEnableVertexAttribArray(attribute.location);
    glVertexAttribPointer(attribute.location,
                          attribute.components,
                          attribute.values == Values::floats ? GL_FLOAT : GL_UNSIGNED_SHORT,
                          attribute.values == Values::unit_16_bit ? GL_TRUE : GL_FALSE,
                          static_cast<GLsizei>(attribute.stride),
                          byte_offset(attribute.offset));
    glVertexAttribDivisor(attribute.location, attribute.per_instance ? 1 : 0);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
    glBindVertexArray(0);
}

void VertexArray::attach_indices(const Buffer& buffer) const {
    glBindVertexArray(id());
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer.id());
    glBindVertexArray(0);
}

Texture::Texture(const PixelSize& size, std::span<const std::byte> rgba, Filter filter)
    : handle_(made(glGenTextures)) {
    expects(size.width > 0 && size.height > 0, "a texture has an area");
    expects(rgba.empty() || std::ssize(rgba) == std::ptrdiff_t{4} * size.width * size.height,
            "a texture gets four bytes per pixel");
    const GLint sampling = filter == Filter::linear ? GL_LINEAR : GL_NEAREST;
    glBindTexture(GL_TEXTURE_2D, id());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, sampling);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, sampling);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    const void* bytes = rgba.empty() ? nullptr : rgba.data();
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, size.width, size.height, 0, GL_RGBA, GL_UNSIGNED_BYTE, bytes);
    glBindTexture(GL_TEXTURE_2D, 0);
}

} // namespace millwright::render
