#include "core/geometry/presets.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <array>
#include <string>

namespace millwright::geometry {

namespace {

using Row4 = std::array<double, 4>;
using Net4 = std::array<Row4, 4>;

Surface single_patch(ControlNet net) {
    return Surface({BezierPatch(std::move(net))});
}

/// A bicubic sheet: x follows the rows, y the columns.
Surface bicubic_sheet(const Row4& x, const Row4& y, const Net4& z) {
    ControlNet net = ControlNet::sized(4, 4);
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
            const auto row = static_cast<std::size_t>(i);
            const auto column = static_cast<std::size_t>(j);
            net.point(i, j) = {x[row], y[column], z[row][column]};
        }
    }
    return single_patch(std::move(net));
}

constexpr Row4 thesis_side{10.0, 30.0, 60.0, 90.0};

Surface dome() {
    constexpr Row4 edge{1.0, 1.0, 1.0, 1.0};
    constexpr Row4 inner{1.0, 90.0, 90.0, 1.0};
    return bicubic_sheet(thesis_side, thesis_side, {edge, inner, inner, edge});
}

Surface dome_text() {
    constexpr Row4 edge{0.0, 0.0, 0.0, 0.0};
    constexpr Row4 inner{0.0, 90.0, 90.0, 0.0};
    return bicubic_sheet(thesis_side, thesis_side, {edge, inner, inner, edge});
}

Surface sine_with(double third_value) {
    constexpr Row4 edge{0.0, 0.0, 0.0, 0.0};
    constexpr Row4 crest{40.0, 40.0, 40.0, 40.0};
    const Row4 trough{-40.0, -40.0, third_value, -40.0};
    return bicubic_sheet(thesis_side, thesis_side, {edge, trough, crest, edge});
}

Surface sine() {
    return sine_with(-40.0);
}

Surface sine_as_printed() {
    return sine_with(40.0);
}

Surface matlab_demo() {
    constexpr Row4 unit_side{0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0}; // x = u and y = v
    constexpr Row4 edge{0.0, 0.3, 0.3, 0.0};
    constexpr Row4 inner{0.3, 0.6, 0.6, 0.3};
    return bicubic_sheet(unit_side, unit_side, {edge, inner, inner, edge});
}

/// z = 400 v(1-v) f(u) - 28 with f of degree 4: exactly a patch of degrees 4 and 2.
Surface two_bell() {
    // f(u) = 3.55u - 14.8u^2 + 21.15u^3 - 9.9u^4 in Bernstein form: b_i = sum_k C(i,k)/C(4,k) a_k
    constexpr std::array<double, 5> a{0.0, 3.55, -14.8, 21.15, -9.9};
    constexpr std::array<std::array<double, 5>, 5> ratio{{{1.0, 0.0, 0.0, 0.0, 0.0},
                                                          {1.0, 1.0 / 4.0, 0.0, 0.0, 0.0},
                                                          {1.0, 2.0 / 4.0, 1.0 / 6.0, 0.0, 0.0},
                                                          {1.0, 3.0 / 4.0, 3.0 / 6.0, 1.0 / 4.0, 0.0},
                                                          {1.0, 1.0, 1.0, 1.0, 1.0}}};
    constexpr std::array<double, 3> v_1_minus_v{0.0, 0.5, 0.0};
    ControlNet net = ControlNet::sized(5, 3);
    for (int i = 0; i < 5; ++i) {
        double f = 0.0;
        for (std::size_t k = 0; k < 5; ++k) {
            f += ratio[static_cast<std::size_t>(i)][k] * a[k];
        }
        for (int j = 0; j < 3; ++j) {
            const double z = 400.0 * v_1_minus_v[static_cast<std::size_t>(j)] * f - 28.0;
            net.point(i, j) = {25.0 * i - 50.0, 50.0 * j - 50.0, z};
        }
    }
    return single_patch(std::move(net));
}

/// z = 18 ((2u-1)^2 - (2v-1)^2): exactly biquadratic, its normal is vertical in the middle alone.
Surface saddle() {
    constexpr double height = 18.0;
    constexpr std::array<double, 3> square{1.0, -1.0, 1.0}; // (2t-1)^2 in Bernstein form
    ControlNet net = ControlNet::sized(3, 3);
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            const double z =
                height * (square[static_cast<std::size_t>(i)] - square[static_cast<std::size_t>(j)]);
            net.point(i, j) = {50.0 * i - 50.0, 50.0 * j - 50.0, z};
        }
    }
    return single_patch(std::move(net));
}

constexpr std::array<SurfacePreset, 7> presets{{
    {"dome", "Dome", "Parasilmongkol 1997, appendix listing", dome},
    {"dome-text", "Dome (text)", "Parasilmongkol 1997, ch. 2; x and y nets of the listing", dome_text},
    {"sine", "Sine sheet", "Parasilmongkol 1997, ch. 2, with the missing minus sign restored", sine},
    {"sine-as-printed",
     "Sine sheet (as printed)",
     "Parasilmongkol 1997, ch. 2, third value of row 1 as printed",
     sine_as_printed},
    {"matlab-demo", "MATLAB demo patch", "Parasilmongkol 1997, ch. 2, MATLAB example", matlab_demo},
    {"two-bell", "Two bells", "test surface of the 5-axis tool path literature", two_bell},
    {"saddle", "Saddle", "ours: z = 18 ((2u-1)^2 - (2v-1)^2) mm over 100 x 100 mm", saddle},
}};

} // namespace

std::span<const SurfacePreset> surface_presets() {
    return presets;
}

const SurfacePreset& surface_preset(std::string_view id) {
    std::string known;
    for (const SurfacePreset& preset : presets) {
        if (preset.id == id) {
            return preset;
        }
        known += known.empty() ? "" : ", ";
        known += preset.id;
    }
    throw Error(fmt::format("unknown surface preset '{}'", id), {}, "use one of: " + known);
}

} // namespace millwright::geometry
