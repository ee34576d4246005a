#include "ui/render/shader_program.h"

#include "core/base/error.h"
#include "ui/render/internal/embedded_shaders.h"
#include "ui/render/internal/gl.h"

#include <glm/gtc/type_ptr.hpp>

#include <string_view>

namespace millwright::render {

namespace {

/// A shader that is being compiled; deleted again once the program holds it.
class Shader {
public:
    Shader(GLenum kind, const std::string& source) : id_(glCreateShader(kind)) {
        const char* text = source.c_str();
        glShaderSource(id_, 1, &text, nullptr);
        glCompileShader(id_);
    }
    Shader(const Shader&) = delete;
    Shader& operator=(const Shader&) = delete;
    ~Shader() { glDeleteShader(id_); }

    [[nodiscard]] GLuint id() const { return id_; }

    void check() const {
        GLint compiled = 0;
        glGetShaderiv(id_, GL_COMPILE_STATUS, &compiled);
        if (compiled != 0) {
            return;
        }
        GLint length = 0;
        glGetShaderiv(id_, GL_INFO_LOG_LENGTH, &length);
        std::string log(static_cast<std::size_t>(length), '\0');
        glGetShaderInfoLog(id_, length, &length, log.data());
        throw Defect("a shader does not compile: " + log.substr(0, static_cast<std::size_t>(length)));
    }

private:
    GLuint id_;
};

void check_linked(GLuint program) {
    GLint linked = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked != 0) {
        return;
    }
    GLint length = 0;
    glGetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(length), '\0');
    glGetProgramInfoLog(program, length, &length, log.data());
    throw Defect("shaders do not link: " + log.substr(0, static_cast<std::size_t>(length)));
}

} // namespace

std::string shader_source(const std::string& file) {
    std::string source(embedded_shader(file));
    expects(!source.empty(), "there is a shader " + file);
    constexpr std::string_view keyword = "#include \"";
    for (auto at = source.find(keyword); at != std::string::npos; at = source.find(keyword)) {
        const auto name_at = at + keyword.size();
        const auto name_end = source.find('"', name_at);
        expects(name_end != std::string::npos, "an included shader's name ends with a quote");
        const std::string included = shader_source(source.substr(name_at, name_end - name_at));
        source.replace(at, name_end + 1 - at, included);
    }
    return source;
}

ShaderProgram::ShaderProgram(const std::string& vertex, const std::string& fragment)
    : handle_(glCreateProgram()) {
    const Shader vertex_shader(GL_VERTEX_SHADER, vertex);
    const Shader fragment_shader(GL_FRAGMENT_SHADER, fragment);
    vertex_shader.check();
    fragment_shader.check();
    glAttachShader(handle_.id(), vertex_shader.id());
    glAttachShader(handle_.id(), fragment_shader.id());
    glLinkProgram(handle_.id());
    check_linked(handle_.id());
    glDetachShader(handle_.id(), vertex_shader.id());
    glDetachShader(handle_.id(), fragment_shader.id());
}

void ShaderProgram::use() const {
    glUseProgram(handle_.id());
}

void ShaderProgram::set(const char* name, int value) const {
    glUniform1i(glGetUniformLocation(handle_.id(), name), value);
}

void ShaderProgram::set(const char* name, float value) const {
    glUniform1f(glGetUniformLocation(handle_.id(), name), value);
}

void ShaderProgram::set(const char* name, const glm::vec2& value) const {
    glUniform2fv(glGetUniformLocation(handle_.id(), name), 1, glm::value_ptr(value));
}

void ShaderProgram::set(const char* name, const glm::vec3& value) const {
    glUniform3fv(glGetUniformLocation(handle_.id(), name), 1, glm::value_ptr(value));
}

void ShaderProgram::set(const char* name, const glm::vec4& value) const {
    glUniform4fv(glGetUniformLocation(handle_.id(), name), 1, glm::value_ptr(value));
}

void ShaderProgram::set(const char* name, const glm::mat4& value) const {
    glUniformMatrix4fv(glGetUniformLocation(handle_.id(), name), 1, GL_FALSE, glm::value_ptr(value));
}

} // namespace millwright::render
