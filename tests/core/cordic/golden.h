// Vectors in exact hexadecimal, recomputed for binary64 with sigma(0) = +1 by a program that shares nothing
// with ours. Angles and shifts: thesis table 3.3; arcs: its experiment of figure 5.7 (centre (5, 10), start
// (10, 10), 3 pi/2 in 50 chords, V = 0.5, A = 0.3). Source of the inputs: thesis chapter 5.
#pragma once

#include <array>

namespace millwright::cordic::golden {

struct Rotation {
    double x, y, z, x_out, y_out, z_out;
};
inline constexpr std::array<Rotation, 8> rotations = {{
    {1, 0, 0, 0x1.ffffffe13ae61p-1, 0x1.beebeb6247138p-25, -0x1.beebeb7cff81fp-25},
    {1, 0, 0.5235987755982988, 0x1.bb67ae23e0f8ap-1, 0x1.0000006b93d5ap-1, -0x1.1bf836df41ba6p-26},
    {1, 0, 0x1.921fb54442d18p-1, 0x1.6a09e5d3099a3p-1, 0x1.6a09e6d159f91p-1, -0x1.67a77be49ee46p-26},
    {1, 0, 0x1.921fb54442d18p+0, -0x1.fde76bfbd9d5bp-25, 0x1.ffffffe13ae5fp-1, -0x1.fde76c163c73bp-25},
    {1, 0, -0x1.921fb54442d18p+0, -0x1.fde76bfbd9d5bp-25, -0x1.ffffffe13ae5fp-1, 0x1.fde76c163c73bp-25},
    {0.5, 0, 0.7, 0x1.879964df0c189p-2, 0x1.49d6e6bd9399ap-2, -0x1.3f1cfa0c15ed4p-27},
    {3, 4, -1.2, 0x1.342cb8b559c03p+2, -0x1.58c06e2ad340cp+0, 0x1.0c74ab2692f08p-28},
    {1, 0, 1.7, -0x1.07dfa3644e2b5p-3, 0x1.fbbb7d31d5d4bp-1, -0x1.0cbe36ad25583p-25},
}};

struct Vectoring {
    double x, y, length, angle;
};
inline constexpr std::array<Vectoring, 7> vectorings = {{
    {1, 0, 0x1.ffffffe13ae61p-1, 0x1.beebeb7cff81fp-25},
    {1, 1, 0x1.6a09e65231c99p+0, 0x1.921fb5f8168f6p-1},
    {3, 4, 0x1.3fffffecc4cfcp+2, 0x1.dac66e972fc98p-1},
    {4, -3, 0x1.3fffffecc4d00p+2, -0x1.4978fbaa82a74p-1},
    {0, 1, 0x1.ffffffe13ae5fp-1, 0x1.921fb64336879p+0},
    {0, -1, 0x1.ffffffe13ae5fp-1, -0x1.921fb64336879p+0},
    {100, 0.001, 0x1.8fffffe84bea2p+6, 0x1.4dbeebeb57947p-17},
}};

struct Line {
    double x, y, folded_x, folded_y;
    bool f1, f2;
    double vx, vy;
};
/// From (0, 0) with V = 0.5.
inline constexpr std::array<Line, 12> lines = {{
    {10, 0, 10, 0, false, false, 0x1.ffffffe13ae61p-2, 0x1.beebeb6247138p-26},
    {8, 6, 8, 6, false, false, 0x1.9999989f537ccp-2, 0x1.3333344d9d84bp-2},
    {6, 8, 8, -6, true, false, 0x1.3333344d9d84bp-2, 0x1.9999989f537ccp-2},
    {0, 10, 10, -0.0, true, false, -0x1.beebeb6247138p-26, 0x1.ffffffe13ae61p-2},
    {-6, 8, 8, 6, true, false, -0x1.3333344d9d84bp-2, 0x1.9999989f537ccp-2},
    {-8, 6, 6, 8, true, false, -0x1.99999874d4c46p-2, 0x1.333334864679bp-2},
    {-10, 0, 0, 10, true, false, -0x1.ffffffe13ae5fp-2, -0x1.fde76bfbd9d5bp-26},
    {-8, -6, 6, -8, true, true, -0x1.99999874d4c46p-2, -0x1.333334864679bp-2},
    {-6, -8, 6, 8, false, true, -0x1.333334864679bp-2, -0x1.99999874d4c46p-2},
    {0, -10, 0, -10, false, false, -0x1.fde76bfbd9d5bp-26, -0x1.ffffffe13ae5fp-2},
    {6, -8, 6, -8, false, false, 0x1.333334864679bp-2, -0x1.99999874d4c46p-2},
    {8, -6, 8, -6, false, false, 0x1.9999989f537ccp-2, -0x1.3333344d9d84bp-2},
}};

struct ArcPoint {
    bool counter_clockwise;
    int chord;
    double x, y;   ///< exact
    double vx, vy; ///< to 12 decimals
};
inline constexpr std::array<ArcPoint, 10> arc_points = {{
    {true, 1, 0x1.3f4a37cf1e5c6p+3, 0x1.4f0eacf794d8fp+3, -0.023553266610, 0.499444933742},
    {true, 10, 0x1.fc1761419ff5fp+2, 0x1.c17154747a064p+3, -0.390215167709, 0.312621370188},
    {true, 25, 0x1.76e764186e6a2p+0, 0x1.b1231b300f8dap+3, -0.369815723661, -0.336506060483},
    {true, 40, 0x1.e8ea60e671fb0p-1, 0x1.c3e8b1afe2877p+2, 0.274511092112, -0.417903886697},
    {true, 50, 0x1.3fffea38d8a72p+2, 0x1.400003c190060p+2, 0.499444911280, -0.023553742918},
    {false, 1, 0x1.3f4a37cf1e5c6p+3, 0x1.30f153086b271p+3, -0.023553210423, -0.499444936392},
    {false, 10, 0x1.fc1761419ff5fp+2, 0x1.7d1d57170bf37p+2, -0.390215167709, -0.312621370188},
    {false, 25, 0x1.76e764186e6aep+0, 0x1.9db9c99fe0e50p+2, -0.369815723661, 0.336506060483},
    {false, 40, 0x1.e8ea60e671fe0p-1, 0x1.9e0ba7280ebc2p+3, 0.274511083087, 0.417903892625},
    {false, 50, 0x1.3fffea38d8a74p+2, 0x1.dffffe1f37fcfp+3, 0.499444911280, 0.023553742918},
}};

struct Angle {
    double binary64;
    unsigned binary32; ///< its bits
};
/// atan 2^-s for s = 1, 2 ...
inline constexpr std::array<Angle, 24> circular_angles = {{
    {0x1.dac670561bb4fp-2, 0x3eed6338},  {0x1.f5b75f92c80ddp-3, 0x3e7adbb0},
    {0x1.fd5ba9aac2f6ep-4, 0x3dfeadd5},  {0x1.ff55bb72cfdeap-5, 0x3d7faade},
    {0x1.ffd55bba97625p-6, 0x3cffeaae},  {0x1.fff555bbb729bp-7, 0x3c7ffaab},
    {0x1.fffd555bbba97p-8, 0x3bfffeab},  {0x1.ffff5555bbbb7p-9, 0x3b7fffab},
    {0x1.ffffd5555bbbcp-10, 0x3affffeb}, {0x1.fffff55555bbcp-11, 0x3a7ffffb},
    {0x1.fffffd55555bcp-12, 0x39ffffff}, {0x1.ffffff555555cp-13, 0x39800000},
    {0x1.ffffffd555556p-14, 0x39000000}, {0x1.fffffff555555p-15, 0x38800000},
    {0x1.fffffffd55555p-16, 0x38000000}, {0x1.ffffffff55555p-17, 0x37800000},
    {0x1.ffffffffd5555p-18, 0x37000000}, {0x1.fffffffff5555p-19, 0x36800000},
    {0x1.fffffffffd555p-20, 0x36000000}, {0x1.ffffffffff555p-21, 0x35800000},
    {0x1.ffffffffffd55p-22, 0x35000000}, {0x1.fffffffffff55p-23, 0x34800000},
    {0x1.fffffffffffd5p-24, 0x34000000}, {0x1.ffffffffffff5p-25, 0x33800000},
}};

/// atanh 2^-s for s = 1, 2 ...
inline constexpr std::array<double, 24> hyperbolic_angles = {
    0x1.193ea7aad030bp-1,  0x1.058aefa811452p-2,  0x1.015891c9eaef7p-3,  0x1.005588ad375adp-4,
    0x1.001558891aee2p-5,  0x1.000555888ad1dp-6,  0x1.000155588891bp-7,  0x1.000055558888bp-8,
    0x1.0000155558889p-9,  0x1.0000055555889p-10, 0x1.0000015555589p-11, 0x1.0000005555559p-12,
    0x1.0000001555556p-13, 0x1.0000000555555p-14, 0x1.0000000155555p-15, 0x1.0000000055555p-16,
    0x1.0000000015555p-17, 0x1.0000000005555p-18, 0x1.0000000001555p-19, 0x1.0000000000555p-20,
    0x1.0000000000155p-21, 0x1.0000000000055p-22, 0x1.0000000000015p-23, 0x1.0000000000005p-24,
};

} // namespace millwright::cordic::golden
