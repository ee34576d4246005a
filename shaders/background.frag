#version 330 core
// A soft gradient. A little fixed noise, less than half a step of 8 bits, hides the bands.
in float height;
uniform vec3 top;
uniform vec3 bottom;
out vec4 color;

void main() {
    float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
    float t = smoothstep(0.0, 1.0, clamp(height, 0.0, 1.0));
    color = vec4(mix(bottom, top, t) + 0.98 * (noise - 0.5) / 255.0, 1.0);
}
