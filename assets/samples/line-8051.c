// The line of the thesis's speed comparison on an MCS-51, after the description in its appendix A: signs and
// amounts of the way, its length, and the parts of speed and acceleration along the axes, in single precision.
// P1.0 is high while it computes. Build it with SDCC, and count its clocks:
//     sdcc -mmcs51 line-8051.c
//     millwright cordic compare --mcs51 line-8051.ihx --line 5,7,4,8
#include <8051.h>
#include <math.h>

// What the host leaves and finds in external memory, lowest byte first. Lengths in thousandths.
__xdata __at(0x0000) long x0;
__xdata __at(0x0004) long x1;
__xdata __at(0x0008) long y0;
__xdata __at(0x000c) long y1;
__xdata __at(0x0010) float speed;
__xdata __at(0x0014) float acceleration;
__xdata __at(0x0018) float results[4]; // vx, vy, ax, ay; the signs are apart, as in the thesis
__xdata __at(0x0028) signed char signs[2];

static signed char sign_of(long way) {
    return way < 0 ? -1 : 1;
}

static long amount_of(long way) {
    return way < 0 ? -way : way;
}

void main(void) {
    long from_x, to_x, from_y, to_y; // on the chip before the clock starts, as in the thesis
    float v, a, dx, dy, length, vx, vy, ax, ay;
    signed char sign_x, sign_y;
    P1_0 = 0;
    EA = 0;
    for (;;) {
        from_x = x0;
        to_x = x1;
        from_y = y0;
        to_y = y1;
        v = speed;
        a = acceleration;
        P1_0 = 1;
        sign_x = sign_of(to_x - from_x);
        sign_y = sign_of(to_y - from_y);
        dx = amount_of(to_x - from_x) / 1000.0f;
        dy = amount_of(to_y - from_y) / 1000.0f;
        length = sqrtf(dx * dx + dy * dy);
        dy = dy / length;
        dx = dx / length;
        vy = v * dy;
        vx = v * dx;
        ay = a * dy;
        ax = a * dx;
        P1_0 = 0;
        results[0] = vx;
        results[1] = vy;
        results[2] = ax;
        results[3] = ay;
        signs[0] = sign_x;
        signs[1] = sign_y;
    }
}
