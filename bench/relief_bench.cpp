// How fast a picture of 4 million pixels becomes a relief, with the tip of the tool made up for.
#include "core/base/units.h"
#include "core/plot/picture/relief.h"

#include <benchmark/benchmark.h>

#include <cmath>

namespace millwright::plot {
namespace {

/// Waves of several lengths, as uneven as a photograph.
Picture waves(int side) {
    Picture picture{side, side, {}, {}};
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            const double u = 0.01 * column;
            const double v = 0.013 * row;
            const double level = 0.5 + 0.2 * std::sin(u) * std::cos(v) + 0.15 * std::sin(7.0 * u + 3.0 * v) +
                                 0.1 * std::sin(31.0 * v - 17.0 * u);
            picture.gray.push_back(static_cast<std::uint16_t>(level * white));
        }
    }
    return picture;
}

/// The arguments are what the tool is, and how many micrometres a pixel is wide.
void relief_of_4_megapixels(benchmark::State& state, const ToolTip& tip) {
    const double pitch = 1e-3 * static_cast<double>(state.range(0));
    const HeightField field = height_field(waves(2000), pitch, 3.0);
    ReliefSettings settings;
    settings.tip = tip;
    settings.step_over = 0.1 * tip.diameter;
    settings.merge_tolerance = 0.005;
    std::size_t points = 0;
    for (auto _ : state) {
        points = relief(field, settings).size();
    }
    state.counters["points"] = static_cast<double>(points);
    state.SetItemsProcessed(state.iterations() * 2000 * 2000);
}
BENCHMARK_CAPTURE(relief_of_4_megapixels, ball_1, ToolTip{TipKind::ball, 1.0})
    ->Unit(benchmark::kMillisecond)
    ->Arg(100)
    ->Arg(50);
BENCHMARK_CAPTURE(relief_of_4_megapixels, ball_3, ToolTip{TipKind::ball, 3.0})
    ->Unit(benchmark::kMillisecond)
    ->Arg(100);
BENCHMARK_CAPTURE(relief_of_4_megapixels, flat_1, ToolTip{TipKind::flat, 1.0})
    ->Unit(benchmark::kMillisecond)
    ->Arg(100);
BENCHMARK_CAPTURE(relief_of_4_megapixels, v_60, ToolTip{TipKind::v, 1.0, from_degrees(60.0)})
    ->Unit(benchmark::kMillisecond)
    ->Arg(100);

} // namespace
} // namespace millwright::plot
