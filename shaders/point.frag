#version 330 core
#include "coloring.glsl"
#include "coverage.glsl"
noperspective in vec2 from_center;
flat in float radius;
flat in float is_selected;
flat in vec4 vertex_color;
flat in float vertex_value;

uniform float ring_px;
uniform vec4 ring_color;
uniform vec4 selected_color;

out vec4 color;

void main() {
    float distance_px = length(from_center);
    float coverage = clamp(radius + 0.5 - distance_px, 0.0, 1.0);
    keep_pass(coverage);
    vec4 fill = is_selected > 0.5 ? selected_color : base_color(vertex_color, vertex_value);
    float ring = ring_px > 0.0 ? clamp(distance_px - (radius - ring_px) + 0.5, 0.0, 1.0) : 0.0;
    vec4 base = mix(fill, ring_color, ring);
    color = vec4(base.rgb, base.a * coverage);
}
