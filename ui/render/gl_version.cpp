#include "ui/render/internal/gl_version.h"

#include "ui/render/internal/gl.h"

namespace millwright::render {

std::optional<std::string> too_old() {
    const int version = epoxy_gl_version();
    if (epoxy_is_desktop_gl() && version >= 10 * gl_major + gl_minor) {
        return std::nullopt;
    }
    return "OpenGL 3.3 is required, but this system has " + std::to_string(version / 10) + "." +
           std::to_string(version % 10);
}

std::string gl_hint() {
    return "install the graphics driver or the software renderer (Debian: libgl1-mesa-dri)";
}

} // namespace millwright::render
