#version 330 core
// A point of a long path. Its piece has the colour of the point where it ends (the provoking vertex of a line).
#include "nearer.glsl"
layout(location = 0) in vec3 place; // 0 to 1 in the box of its buffer
layout(location = 1) in float kind;

uniform mat4 eye_from_buffer;
uniform vec4 kind_color[4];
uniform vec4 done_color[4];
uniform int done; // points up to this one are done

flat out vec4 piece_color;

void main() {
    const float lift = 1.5;
    int k = int(kind + 0.5);
    piece_color = gl_VertexID <= done ? done_color[k] : kind_color[k];
    gl_Position = clip_from_eye * nearer(eye_from_buffer * vec4(place, 1.0), lift);
}
