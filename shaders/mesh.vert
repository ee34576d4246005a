#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 color;
layout(location = 3) in float value;

uniform mat4 eye_from_buffer;
uniform mat4 clip_from_eye;

out vec3 eye_position;
out vec3 eye_normal;
out vec4 vertex_color;
out float vertex_value;

void main() {
    vec4 p = eye_from_buffer * vec4(position, 1.0);
    eye_position = p.xyz;
    eye_normal = mat3(eye_from_buffer) * normal;
    vertex_color = color;
    vertex_value = value;
    gl_Position = clip_from_eye * p;
}
