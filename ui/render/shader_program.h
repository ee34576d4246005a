// A vertex and a fragment shader, linked, with their uniforms by name.
#pragma once

#include "ui/render/gl_objects.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <string>

namespace millwright::render {

/// `shaders/NAME` as it was built in, with `#include` of other shaders resolved. Throws Defect if there is
/// none.
[[nodiscard]] std::string shader_source(const std::string& file);

class ShaderProgram {
public:
    /// Sources in GLSL. Throws Defect with the compiler's log.
    ShaderProgram(const std::string& vertex, const std::string& fragment);

    void use() const;

    /// Each sets the uniform of this program, which must be in use. A name that the linker dropped is
    /// ignored.
    void set(const char* name, int value) const;
    void set(const char* name, float value) const;
    void set(const char* name, const glm::vec2& value) const;
    void set(const char* name, const glm::vec3& value) const;
    void set(const char* name, const glm::vec4& value) const;
    void set(const char* name, const glm::mat4& value) const;

private:
    GlHandle<ProgramKind> handle_;
};

} // namespace millwright::render
