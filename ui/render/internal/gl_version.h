// What we ask of OpenGL.
#pragma once

#include <optional>
#include <string>

namespace millwright::render {

inline constexpr int gl_major = 3;
inline constexpr int gl_minor = 3;

/// Of the current context: nothing if it will do, else the sentence why not.
[[nodiscard]] std::optional<std::string> too_old();

/// What a user can do when there is no OpenGL.
[[nodiscard]] std::string gl_hint();

} // namespace millwright::render
