#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 color;
layout(location = 3) in float value;

uniform mat4 eye_from_buffer;
uniform mat4 clip_from_eye;
uniform mat4 light_from_buffer; // eye_from_buffer without the shear of an oblique view

out vec4 normal_and_value; // one slot for both: software renderers pay for each
out vec4 vertex_color;

void main() {
    normal_and_value = vec4(mat3(light_from_buffer) * normal, value);
    vertex_color = color;
    gl_Position = clip_from_eye * (eye_from_buffer * vec4(position, 1.0));
}
