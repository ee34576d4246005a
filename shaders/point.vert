#version 330 core
// A point becomes a square on the screen, wide enough for a soft edge.
#include "nearer.glsl"
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 color;
layout(location = 2) in float value;
layout(location = 3) in float selected;

uniform mat4 eye_from_buffer;
uniform float radius_px;
uniform float selected_radius_px;

noperspective out vec2 from_center; // px
flat out float radius;
flat out float is_selected;
flat out vec4 vertex_color;
flat out float vertex_value;

void main() {
    is_selected = selected;
    radius = selected > 0.5 ? selected_radius_px : radius_px;
    vertex_color = color;
    vertex_value = value;
    vec4 clip = clip_from_eye * nearer(eye_from_buffer * vec4(position, 1.0), 2.0 * radius + 4.0);
    vec2 corner = vec2((gl_VertexID & 1) != 0 ? 1.0 : -1.0, (gl_VertexID & 2) != 0 ? 1.0 : -1.0);
    from_center = (radius + 1.0) * corner;
    gl_Position = vec4(clip.xy + from_center * 2.0 / picture_px * clip.w, clip.z, clip.w);
    if (clip.w <= 0.0) {
        gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    }
}
