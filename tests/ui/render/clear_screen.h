// The whole target in one colour.
#pragma once

#include <epoxy/gl.h>

namespace millwright::render {

inline void clear_screen(float red, float green, float blue) {
    glClearColor(red, green, blue, 1.0F);
    glClear(GL_COLOR_BUFFER_BIT);
}

} // namespace millwright::render
