// Smooth shapes are drawn in two passes: the solid inside hides what is behind, then the soft edge blends over
// it. In one pass the soft edge of a joint would hide the line that goes on behind it.
uniform int pass; // 0 everything, 1 the solid inside, 2 the soft edge

const float solid = 0.99;
const float nothing = 0.004; // below half a step of 8 bits

void keep_pass(float coverage) {
    if (coverage < nothing || (pass == 1 && coverage < solid) || (pass == 2 && coverage >= solid)) {
        discard;
    }
}
