#version 330 core
#include "coloring.glsl"
in vec4 normal_and_value;
in vec4 vertex_color;

uniform mat4 clip_from_eye;
uniform vec2 picture_px;
uniform vec3 up; // the scene's z axis seen from the eye
uniform int lit;
uniform float highlight;
uniform int has_back;
uniform vec3 back_color;

out vec4 color;

// Seen from the eye, unit length: over the left shoulder, and low from the right so that undersides keep a shape.
const vec3 key_light = vec3(-0.5571, 0.5571, 0.6160);
const vec3 fill_light = vec3(0.6667, -0.3333, 0.6667);

vec3 direction_to_eye() {
    if (clip_from_eye[3][3] > 0.5) {
        return vec3(0.0, 0.0, 1.0);
    }
    vec2 device = 2.0 * gl_FragCoord.xy / picture_px - 1.0;
    return normalize(vec3(-device.x / clip_from_eye[0][0], -device.y / clip_from_eye[1][1], 1.0));
}

float shine(vec3 n, vec3 to_eye) {
    float s = max(dot(n, normalize(key_light + to_eye)), 0.0);
    s *= s;
    s *= s;
    s *= s;
    s *= s;
    return s * s; // to the 32nd
}

void main() {
    vec4 base = base_color(vertex_color, normal_and_value.w);
    if (!gl_FrontFacing && has_back != 0) {
        base.rgb = back_color;
    }
    color = base;
    if (lit != 0) {
        vec3 n = normalize(gl_FrontFacing ? normal_and_value.xyz : -normal_and_value.xyz);
        vec3 to_eye = direction_to_eye();
        float light = 0.14 + 0.72 * max(dot(n, key_light), 0.0) + 0.22 * max(dot(n, fill_light), 0.0) +
                      0.14 * (0.5 + 0.5 * dot(n, up));
        // Squares stand for linear light, close enough to sRGB and much cheaper.
        color.rgb = sqrt(base.rgb * base.rgb * light + highlight * shine(n, to_eye));
    }
}
