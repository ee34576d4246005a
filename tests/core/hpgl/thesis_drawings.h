// The whole parts of the plot listings of the KMITL master's thesis of 2006 (forming software for wood and
// plastic), as HPGL: examples, figure 3.3 and the engraving of figure 4.5.
#pragma once

#include <initializer_list>
#include <string>
#include <utility>

namespace millwright::test {

struct At {
    int x = 0;
    int y = 0;
};

inline std::string position(At at) {
    return "PA" + std::to_string(at.x) + "," + std::to_string(at.y) + ";";
}

/// Up to the first point and down through the others, as AutoCAD writes it.
inline std::string run(std::initializer_list<At> points) {
    std::string text = "PU;" + position(*points.begin()) + "PD;";
    for (const At* point = points.begin() + 1; point != points.end(); ++point) {
        text += position(*point);
    }
    return text + "PU;";
}

inline std::string autocad_head() {
    return "\x1b.(;\x1b.I81;;17:\x1b.N;19:IN;SC;PU;PU;SP1;LT;VS36;";
}

inline std::string first_example() {
    return "SP1;" + run({{2994, 4197}, {3093, 4165}, {3047, 4144}, {3000, 4100}}) + position({2994, 4197});
}

inline std::string second_example() {
    return "SP0;" + run({{2994, 4197}, {3093, 4165}}) + "SP1;" + run({{3540, 4684}, {3200, 4505}});
}

inline std::string outline_fa() {
    return run({{893, 692}, {893, 800}, {1039, 800}, {1154, 811}, {1254, 844}, {1340, 899}, {1341, 900}});
}

inline std::string hatch_fb() {
    return run({{1509, 2984}, {1961, 2984}}) + run({{1961, 3048}, {1509, 3048}}) +
           run({{1509, 3111}, {1961, 3111}}) + run({{1961, 3175}, {1509, 3175}}) +
           run({{1509, 3238}, {1961, 3238}}) + run({{1961, 3302}, {1509, 3302}}) + position({1509, 3365});
}

inline std::string hatch_fc_fd() {
    return run({{1509, 2095}, {1961, 2095}}) + run({{1961, 2159}, {1509, 2159}}) +
           run({{1509, 2222}, {1961, 2222}}) + run({{1961, 2286}, {1509, 2286}}) +
           run({{1509, 2349}, {1961, 2349}}) + run({{1961, 2413}, {1509, 2413}}) +
           run({{1509, 2476}, {1961, 2476}}) + run({{1961, 2540}, {1509, 2540}}) +
           run({{1509, 2603}, {1961, 2603}}) + run({{1509, 2667}, {3393, 2667}}) +
           run({{3496, 2730}, {1509, 2730}}) + run({{2768, 4445}, {3461, 4445}}) +
           run({{3634, 4381}, {3052, 4381}}) + position({0, 0});
}

inline std::string listing_start() {
    return run({{431, 390}, {431, 497}, {577, 497}, {692, 508}, {792, 541}, {878, 597}});
}

inline std::string listing_later_part() {
    return run({{2534, 4281}, {2659, 4267}, {2778, 4247}, {2889, 4224}}) + run({{2994, 4197},
                                                                                {3093, 4165},
                                                                                {3184, 4129},
                                                                                {3269, 4088},
                                                                                {3347, 4044},
                                                                                {3419, 3995},
                                                                                {3484, 3942},
                                                                                {3542, 3885},
                                                                                {3593, 3823},
                                                                                {3638, 3758}});
}

} // namespace millwright::test
