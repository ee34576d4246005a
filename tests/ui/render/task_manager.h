// Another program of the desktop that ends the program of a window without a word, as `xkill` does.
#pragma once

struct GLFWwindow;

namespace millwright::test {

/// Needs a display.
void end_program_of(GLFWwindow* window);

} // namespace millwright::test
