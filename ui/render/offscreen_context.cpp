#include "ui/render/offscreen_context.h"

#include "core/base/error.h"
#include "ui/render/framebuffer.h"
#include "ui/render/internal/gl.h"

#include <epoxy/egl.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

namespace millwright::render {

namespace {

[[noreturn]] void no_gl(const std::string& why) {
    throw Error("cannot draw without a display: " + why, {}, gl_hint());
}

bool has_extension(EGLDisplay display, std::string_view extension) {
    const char* list = eglQueryString(display, EGL_EXTENSIONS);
    return list != nullptr && std::string_view(list).find(extension) != std::string_view::npos;
}

/// The display stays open until the process ends: it is the same for everyone who asks for it.
EGLDisplay opened_display() {
    if (!epoxy_has_egl()) { // loaded at run time: most commands do without
        no_gl("EGL is not available");
    }
    EGLDisplay display = EGL_NO_DISPLAY;
    if (has_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
        // Not by epoxy, which ends the program where it does not see the extension of a display in use.
        const auto platform_display =
            reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
        if (platform_display != nullptr) {
            display = platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
        }
    }
    if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) == EGL_FALSE) {
        display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
        if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) == EGL_FALSE) {
            no_gl("EGL cannot be initialised");
        }
    }
    if (!has_extension(display, "EGL_KHR_surfaceless_context")) {
        no_gl("EGL does not support surfaceless contexts");
    }
    return display;
}

EGLContext new_context(EGLDisplay display) {
    if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) {
        no_gl("EGL does not support OpenGL");
    }
    constexpr std::array wanted = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config = EGL_NO_CONFIG_KHR;
    EGLint count = 0;
    if (eglChooseConfig(display, wanted.data(), &config, 1, &count) == EGL_FALSE || count == 0) {
        no_gl("EGL offers no OpenGL configuration");
    }
    constexpr std::array attributes = {EGL_CONTEXT_MAJOR_VERSION,
                                       gl_major,
                                       EGL_CONTEXT_MINOR_VERSION,
                                       gl_minor,
                                       EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                       EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                       EGL_NONE};
    EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, attributes.data());
    if (context == EGL_NO_CONTEXT) {
        no_gl("OpenGL 3.3 is not available");
    }
    return context;
}

} // namespace

/// A context of EGL without a surface. Outside of the anonymous namespace as a member of
/// OffscreenContext::Parts.
class SurfacelessContext {
public:
    SurfacelessContext() : display_(opened_display()), context_(new_context(display_)) {}
    SurfacelessContext(const SurfacelessContext&) = delete;
    SurfacelessContext& operator=(const SurfacelessContext&) = delete;
    ~SurfacelessContext() {
        if (eglGetCurrentContext() == context_) {
            eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        }
        eglDestroyContext(display_, context_);
    }

    void make_current() const {
        if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE) {
            no_gl("the EGL context cannot be activated");
        }
    }

private:
    EGLDisplay display_;
    EGLContext context_;
};

struct OffscreenContext::Parts {
    SurfacelessContext context;
    double content_scale = 1.0;
    std::optional<Framebuffer> picture;
};

OffscreenContext::OffscreenContext(const PixelSize& size, double content_scale)
    : parts_(std::make_unique<Parts>()) {
    parts_->content_scale = content_scale;
    make_current();
    if (const auto why = too_old()) {
        no_gl(*why);
    }
    resize(size);
}

OffscreenContext::~OffscreenContext() {
    // The framebuffer is deleted in its own context.
    try {
        make_current();
    } catch (const Error&) {
        // Then the context is lost, and its objects with it.
    }
}

PixelSize OffscreenContext::framebuffer_size() const {
    return parts_->picture->size();
}

double OffscreenContext::content_scale() const {
    return parts_->content_scale;
}

void OffscreenContext::make_current() {
    parts_->context.make_current();
}

void OffscreenContext::begin() {
    make_current();
    parts_->picture->bind();
}

Picture OffscreenContext::read_back() {
    begin();
    return read_pixels(framebuffer_size(), Alpha::opaque);
}

void OffscreenContext::present() {
    glFinish(); // as a window does, which waits for the screen: dozens of frames in flight would be one slow
                // one
}

void OffscreenContext::resize(const PixelSize& size) {
    make_current();
    parts_->picture.emplace(size);
    begin();
}

} // namespace millwright::render
