// Moves a point towards the eye by some pixel lengths, without moving it on the screen: lines and points that lie
// on a surface are not cut by it.
uniform mat4 clip_from_eye;
uniform vec2 picture_px;

vec4 nearer(vec4 eye_point, float pixels) {
    float pixel = 2.0 / (clip_from_eye[1][1] * picture_px.y); // at depth 1, or everywhere if orthographic
    bool orthographic = clip_from_eye[3][3] > 0.5;
    return orthographic ? eye_point + vec4(0.0, 0.0, pixels * pixel, 0.0)
                        : vec4(eye_point.xyz * max(1.0 - pixels * pixel, 0.5), 1.0);
}
