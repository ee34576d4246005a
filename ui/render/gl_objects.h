// OpenGL's objects as move-only handles that delete themselves. All of them need the current context they
// were made in, also when they die. An object that was moved from holds nothing.
#pragma once

#include "ui/render/pixel_size.h"

#include <cstddef>
#include <span>
#include <utility>

namespace millwright::render {

using GlId = unsigned int; ///< GLuint; 0 is no object

/// Holds one object of the kind that `Kind::remove` deletes.
template <typename Kind> class GlHandle {
public:
    GlHandle() = default;
    explicit GlHandle(GlId id) : id_(id) {}
    GlHandle(GlHandle&& other) noexcept : id_(std::exchange(other.id_, 0U)) {}
    GlHandle& operator=(GlHandle&& other) noexcept {
        std::swap(id_, other.id_);
        return *this;
    }
    GlHandle(const GlHandle&) = delete;
    GlHandle& operator=(const GlHandle&) = delete;
    ~GlHandle() {
        if (id_ != 0U) {
            Kind::remove(id_);
        }
    }

    [[nodiscard]] GlId id() const { return id_; }

private:
    GlId id_ = 0U;
};

struct BufferKind {
    static void remove(GlId id) noexcept;
};
struct VertexArrayKind {
    static void remove(GlId id) noexcept;
};
struct TextureKind {
    static void remove(GlId id) noexcept;
};
struct RenderbufferKind {
    static void remove(GlId id) noexcept;
};
struct FramebufferKind {
    static void remove(GlId id) noexcept;
};
struct ProgramKind {
    static void remove(GlId id) noexcept;
};

/// Vertices or indices in the memory of the graphics processor, fixed once made.
class Buffer {
public:
    Buffer() = default;
    explicit Buffer(std::span<const std::byte> bytes);
    [[nodiscard]] GlId id() const { return handle_.id(); }

private:
    GlHandle<BufferKind> handle_;
};

class VertexArray {
public:
    /// How numbers lie in a buffer; the shader gets floats in any case.
    enum class Values {
        floats,
        unit_16_bit, ///< 0 to 65535 become 0 to 1
        whole_16_bit ///< 0 to 65535
    };
    /// One attribute: `components` values at `offset` in every `stride` bytes. With `per_instance` it
    /// advances once an instance, else once a vertex.
    struct Attribute {
        unsigned int location = 0;
        int components = 0;
        std::ptrdiff_t stride = 0;
        std::ptrdiff_t offset = 0;
        bool per_instance = false;
        Values values = Values::floats;
    };

    VertexArray();
    void attach(const Buffer& buffer, const Attribute& attribute) const;
    void attach_indices(const Buffer& buffer) const;
    [[nodiscard]] GlId id() const { return handle_.id(); }

private:
    GlHandle<VertexArrayKind> handle_;
};

enum class Filter { nearest, linear };

/// A two-dimensional RGBA8 texture, edges clamped.
class Texture {
public:
    Texture() = default;
    /// `rgba` is width * height * 4 bytes, the bottom row first; empty leaves the content undefined.
    Texture(const PixelSize& size, std::span<const std::byte> rgba, Filter filter);
    [[nodiscard]] GlId id() const { return handle_.id(); }

private:
    GlHandle<TextureKind> handle_;
};

} // namespace millwright::render
