#include "tests/ui/render/task_manager.h"

#include "core/base/error.h"

#define GLFW_INCLUDE_NONE
#define GLFW_EXPOSE_NATIVE_X11
#include <GLFW/glfw3.h>
#include <GLFW/glfw3native.h>

namespace millwright::test {

void end_program_of(GLFWwindow* window) {
    Display* display = XOpenDisplay(nullptr);
    expects(display != nullptr, "the display answers a second program");
    XKillClient(display, glfwGetX11Window(window));
    XCloseDisplay(display);
}

} // namespace millwright::test
