#version 330 core
#include "coloring.glsl"
#include "coverage.glsl"
noperspective in vec2 along_across;
flat in float length_px;
flat in float starts;
flat in vec2 goes_on;
in vec4 vertex_color;
in float vertex_value;

uniform float half_width;
uniform float faintness; // below 1 for lines thinner than a pixel
uniform vec2 dash;       // drawn, left out; px

out vec4 color;

float dash_coverage(float along) {
    float period = dash.x + dash.y;
    float place = mod(along, period);
    return clamp(max(min(place, dash.x - place), place - period) + 0.5, 0.0, 1.0);
}

/// The pixel is drawn by the segment before or after this one.
bool is_neighbours() {
    const float overlap = 0.01; // px, so that rounding leaves no hole
    vec2 from_end = along_across - vec2(length_px, 0.0);
    return (starts < 0.5 && along_across.x < 0.0) || (from_end.x > 0.0 && dot(from_end, goes_on) > overlap);
}

void main() {
    if (is_neighbours()) {
        discard;
    }
    float beyond = along_across.x - clamp(along_across.x, 0.0, length_px);
    float coverage = clamp(half_width + 0.5 - length(vec2(beyond, along_across.y)), 0.0, 1.0);
    if (dash.x > 0.0 && dash.y > 0.0) {
        coverage *= dash_coverage(along_across.x);
    }
    keep_pass(coverage);
    vec4 base = base_color(vertex_color, vertex_value);
    color = vec4(base.rgb, base.a * coverage * faintness);
}
