#version 330 core
flat in vec4 piece_color;

out vec4 color;

void main() {
    if (piece_color.a <= 0.0) {
        discard;
    }
    color = piece_color;
}
