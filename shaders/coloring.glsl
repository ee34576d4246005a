// The colour of a fragment before light: the style's, the vertex's, or a value through a colour map.
uniform int color_from; // 0 style, 1 vertex, 2 value
uniform vec4 style_color;
uniform float opacity;
uniform sampler2D maps; // one row of 256 entries a map
uniform int map_row;
uniform int map_count;
uniform float low;
uniform float per_unit; // 1 / (high - low), 0 if they are the same
uniform float limit;
uniform vec3 over_limit;

vec4 base_color(vec4 vertex_color, float value) {
    vec4 color = style_color;
    if (color_from == 1) {
        color = vertex_color;
    } else if (color_from == 2) {
        float t = clamp((value - low) * per_unit, 0.0, 1.0);
        vec2 place = vec2((t * 255.0 + 0.5) / 256.0, (float(map_row) + 0.5) / float(map_count));
        color = vec4(value > limit ? over_limit : texture(maps, place).rgb, 1.0);
    }
    return vec4(color.rgb, color.a * opacity);
}
