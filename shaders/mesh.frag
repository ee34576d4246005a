#version 330 core
#include "coloring.glsl"
in vec3 eye_position;
in vec3 eye_normal;
in vec4 vertex_color;
in float vertex_value;

uniform mat4 clip_from_eye;
uniform vec3 up;         // the scene's z axis seen from the eye
uniform int lit;
uniform float highlight;
uniform int has_back;
uniform vec3 back_color;

out vec4 color;

const vec3 key_light = vec3(-0.2692, 0.4711, 0.8399); // a headlight over the left shoulder

void main() {
    vec4 base = base_color(vertex_color, vertex_value);
    vec3 to_eye = clip_from_eye[3][3] > 0.5 ? vec3(0.0, 0.0, 1.0) : normalize(-eye_position);
    // The side is taken from the flat triangle: the smooth normal turns away too early near the outline.
    vec3 facet = cross(dFdx(eye_position), dFdy(eye_position));
    facet *= dot(facet, to_eye) < 0.0 ? -1.0 : 1.0;
    bool back = dot(eye_normal, facet) < 0.0;
    vec3 n = normalize(back ? -eye_normal : eye_normal);
    if (back && has_back != 0) {
        base.rgb = back_color;
    }
    if (lit == 0) {
        color = base;
        return;
    }
    float key = max(dot(n, key_light), 0.0);
    float sky = 0.5 + 0.5 * dot(n, up);
    float light = 0.62 * key + 0.34 * sky + 0.16;
    float shine = highlight * pow(max(dot(n, normalize(key_light + to_eye)), 0.0), 48.0);
    // Squares stand for linear light, close enough to sRGB and much cheaper.
    vec3 linear = base.rgb * base.rgb * light + vec3(0.6 * shine * shine + 0.25 * shine);
    color = vec4(sqrt(linear), base.a);
}
