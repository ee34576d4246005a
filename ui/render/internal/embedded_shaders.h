// The shaders of the folder shaders/, put into the program when it is built.
#pragma once

#include <string_view>

namespace millwright::render {

/// The text of a shader file; empty if there is none of that name.
[[nodiscard]] std::string_view embedded_shader(std::string_view file);

} // namespace millwright::render
