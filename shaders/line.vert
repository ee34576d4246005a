#version 330 core
// A segment becomes a rectangle around it on the screen, wide enough for round ends and a soft edge.
// Each pixel of a joint belongs to one of its segments, else soft edges would add up and make the line thicker.
#include "nearer.glsl"
layout(location = 0) in vec3 start;
layout(location = 1) in vec4 start_color;
layout(location = 2) in float start_value;
layout(location = 3) in vec3 end;
layout(location = 4) in vec4 end_color;
layout(location = 5) in float end_value;
layout(location = 6) in vec3 next; // where the line goes on; the end itself if it does not

uniform mat4 eye_from_buffer;
uniform float half_width;
uniform int joined; // each segment goes on in the one after it
uniform int last;   // the last segment that is drawn

noperspective out vec2 along_across; // px from the start
flat out float length_px;
flat out float starts;  // 1 if the segment has a round start of its own
flat out vec2 goes_on;  // the direction after its end, along and across; zero if it has a round end
out vec4 vertex_color;
out float vertex_value;

/// The part of a segment in front of the near plane; 1 if none.
float hidden_part(vec4 from, vec4 to) {
    float a = from.z + from.w;
    float b = to.z + to.w;
    return a >= 0.0 ? 0.0 : (b <= 0.0 ? 1.0 : a / (a - b));
}

void main() {
    float lift = half_width + 1.0;
    vec4 a = clip_from_eye * nearer(eye_from_buffer * vec4(start, 1.0), lift);
    vec4 b = clip_from_eye * nearer(eye_from_buffer * vec4(end, 1.0), lift);
    float from = hidden_part(a, b);
    float to = 1.0 - hidden_part(b, a);
    if (from >= to) {
        gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
        return;
    }
    vec4 clip_a = mix(a, b, from);
    vec4 clip_b = mix(a, b, to);
    vec2 screen_a = 0.5 * picture_px * clip_a.xy / clip_a.w;
    vec2 screen_b = 0.5 * picture_px * clip_b.xy / clip_b.w;
    length_px = distance(screen_a, screen_b);
    vec2 along = length_px > 1e-4 ? (screen_b - screen_a) / length_px : vec2(1.0, 0.0);
    vec2 across = vec2(-along.y, along.x);
    starts = joined == 0 || gl_InstanceID == 0 ? 1.0 : 0.0;
    goes_on = vec2(0.0);
    vec4 clip_next = clip_from_eye * nearer(eye_from_buffer * vec4(next, 1.0), lift);
    if (joined != 0 && gl_InstanceID != last && to == 1.0 && clip_next.w > 0.0) {
        vec2 turn = 0.5 * picture_px * clip_next.xy / clip_next.w - screen_b;
        goes_on = length(turn) > 1e-4 ? vec2(dot(turn, along), dot(turn, across)) / length(turn) : vec2(0.0);
    }

    bool at_end = (gl_VertexID & 1) != 0;
    float side = (gl_VertexID & 2) != 0 ? 1.0 : -1.0;
    float reach = half_width + 1.0;
    vec4 clip = at_end ? clip_b : clip_a;
    vec2 screen = (at_end ? screen_b : screen_a) + reach * ((at_end ? along : -along) + side * across);
    along_across = vec2(at_end ? length_px + reach : -reach, side * reach);
    float t = at_end ? to : from;
    vertex_color = mix(start_color, end_color, t);
    vertex_value = mix(start_value, end_value, t);
    gl_Position = vec4(screen * 2.0 / picture_px * clip.w, clip.z, clip.w);
}
