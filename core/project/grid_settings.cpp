// What the numbers and choices of the grids say of themselves.
#include "core/project/grid_methods/grid_method_row.h"
#include "core/project/setting_tables.h"

#include <array>
#include <vector>

namespace millwright::project {

namespace {

using grid::Combination;
using grid::EllipticMethod;
using grid::MixSettings;
using grid::TrackDirection;

constexpr std::array<NumberSetting<GridInput>, 2> of_grid{{
    {"nu",
     "Nodes along u",
     "",
     "Number of grid nodes along u, including the boundary",
     2,
     most_nodes_per_side,
     0,
     field<&GridInput::nu>},
    {"nv",
     "Nodes along v",
     "",
     "Number of grid nodes along v, including the boundary",
     2,
     most_nodes_per_side,
     0,
     field<&GridInput::nv>},
}};

constexpr std::array<NumberSetting<RedistributionInput>, 2> of_redistribution{{
    {"floor",
     "Density floor",
     "",
     "Constant added to sqrt(e) / h, as a multiple of its mean; larger values give more even nodes",
     1e-3,
     1e3,
     3,
     field<&RedistributionInput::floor>},
    {"smoothing_passes",
     "Smoothing",
     "",
     "Binomial smoothing passes over sqrt(e) / h along each track",
     0,
     100,
     0,
     field<&RedistributionInput::smoothing_passes>},
}};

constexpr std::array<NumberSetting<grid::Region>, 1> numbers_of_region{{
    {"border_mm",
     "Blend width",
     "mm",
     "Distance on the surface, outside the outline, over which the adaptation fades out",
     0.0,
     1e3,
     2,
     field<&grid::Region::border_mm>},
}};

constexpr std::array<NumberSetting<EllipticInput>, 8> of_elliptic{{
    {"adaptation",
     "Adaptation",
     "",
     "LV: how strongly the weight attracts cells, relative to smoothness",
     0.0,
     1e4,
     2,
     field<&EllipticInput::adaptation>},
    {"orthogonality",
     "Orthogonality",
     "",
     "LO: how strongly grid lines are kept at right angles, relative to smoothness",
     0.0,
     1e4,
     2,
     field<&EllipticInput::orthogonality>},
    {"relaxation",
     "Relaxation",
     "",
     "WW of the thesis's iteration: share of its old position that a node keeps; not used by the other "
     "solvers",
     0.0,
     0.999,
     3,
     field<&EllipticInput::relaxation>},
    {"tolerance",
     "Residual tolerance",
     "",
     "A round ends when half the largest |R_X| + |R_Y| of any node is at or below this value",
     1e-12,
     1e3,
     6,
     field<&EllipticInput::tolerance>},
    {"max_iterations",
     "Max. iterations",
     "",
     "Maximum number of solver iterations per round",
     1,
     100000,
     0,
     field<&EllipticInput::max_iterations>},
    {"max_rounds",
     "Rounds",
     "",
     "Number of times the error is remeasured and converted to the weight",
     1,
     1000,
     0,
     field<&EllipticInput::max_rounds>},
    {"error_change",
     "Convergence limit",
     "",
     "Delta of the outer loop: stops when a round changes the mean error by at most this share of the mean "
     "error at the start",
     0.0,
     1.0,
     6,
     field<&EllipticInput::error_change>},
    {"iterations_per_step",
     "Refresh interval",
     "",
     "Iterations between display updates while an adaptation is watched; the result is the same",
     1,
     10000,
     0,
     field<&EllipticInput::iterations_per_step>},
}};

constexpr std::array<NumberSetting<MixSettings>, 7> of_mix{{
    {"error",
     "Error share",
     "",
     "Share of the measured error, which is divided by its maximum and raised to the power 0.7",
     0.0,
     1e3,
     2,
     field<&MixSettings::error>},
    {"curvature",
     "Curvature share",
     "",
     "Share of sqrt(k1^2 + k2^2), divided by its maximum",
     0.0,
     1e3,
     2,
     field<&MixSettings::curvature>},
    {"painted", "Paint share", "", "Share of the painted values", 0.0, 1e3, 2, field<&MixSettings::painted>},
    {"expression",
     "Formula share",
     "",
     "Share of the formula's value, which is used unscaled",
     0.0,
     1e3,
     2,
     field<&MixSettings::expression>},
    {"smoothing_passes",
     "Smoothing",
     "",
     "Passes of a nine-point average; the weight has two samples per cell in each direction",
     0,
     100,
     0,
     field<&MixSettings::smoothing_passes>},
    {"low", "Minimum weight", "", "Lower limit of the weight", 1e-6, 1e3, 3, field<&MixSettings::low>},
    {"high", "Maximum weight", "", "Upper limit of the weight", 1e-6, 1e6, 3, field<&MixSettings::high>},
}};

constexpr std::array<NumberSetting<TracksInput>, 4> of_tracks{{
    {"lattice",
     "Candidates",
     "",
     "Lattice points per track from which its nodes are chosen; 0 = automatic: max(160, 4 n) for n nodes",
     0,
     4000,
     0,
     field<&TracksInput::lattice>},
    {"error_exponent",
     "Error exponent",
     "",
     "p in the cost of a move, length * error^p; larger values penalise the worst moves more",
     1.0,
     16.0,
     1,
     field<&TracksInput::error_exponent>},
    {"axis_weight",
     "Tool-axis weight",
     "mm/deg",
     "Error equivalent to one degree between tool axis and surface normal",
     0.0,
     100.0,
     3,
     field<&TracksInput::axis_weight>},
    {"polish_sweeps",
     "Polishing sweeps",
     "",
     "Number of sweeps that move each node individually after the best lattice points are found",
     0,
     1000,
     0,
     field<&TracksInput::polish_sweeps>},
}};

constexpr std::array<NumberSetting<ChainInput>, 3> of_chain{{
    {"first_iterations",
     "Initial iterations",
     "",
     "Maximum number of iterations over all nodes at once, at the error exponent of the tracks",
     0,
     10000,
     0,
     field<&ChainInput::first_iterations>},
    {"later_iterations",
     "Later iterations",
     "",
     "Maximum number of iterations at each of the exponents 4, 6, 8, 16 and 32, which reduce the worst "
     "moves; 0 skips them",
     0,
     10000,
     0,
     field<&ChainInput::later_iterations>},
    {"gap_percent",
     "Track gap",
     "%",
     "Allowed growth of the largest distance between neighbouring tracks; the scallop height grows with its "
     "square",
     0.0,
     100.0,
     1,
     field<&ChainInput::gap_percent>},
}};

constexpr std::array<Choice<TrackDirection>, 2> of_direction{{
    {TrackDirection::along_u, "along-u", "Along u", "Tracks follow the lines of constant v"},
    {TrackDirection::along_v,
     "along-v",
     "Along v",
     "Tracks follow the lines of constant u, as in the thesis's listing"},
}};

std::vector<Choice<GridMethod>> method_choices() {
    std::vector<Choice<GridMethod>> choices;
    for (const GridMethod method : every_grid_method) {
        const GridMethodRow& row = row_of(method);
        choices.push_back({method, row.id, row.label, row.tip});
    }
    return choices;
}

constexpr std::array<Choice<WeightSource>, 7> of_weight{{
    {WeightSource::error, "error", "Error density", "The measured error, e/h^2, scaled and smoothed"},
    {WeightSource::expression, "expression", "Expression", "A formula of position, surface and error"},
    {WeightSource::mixed, "mixed", "Mixed", "Error, curvature, paint and formula, each with its own share"},
    {WeightSource::w1, "w1", "W1 (circle)", "exp(-|25 - (x-10)^2 - (y-10)^2|) + 0.01 in node coordinates"},
    {WeightSource::w2,
     "w2",
     "W2 (circle of nodes)",
     "exp(-|n_x - (x-10)^2 - (y-10)^2|) + 0.01 in node coordinates"},
    {WeightSource::w3,
     "w3",
     "W3 (quarter circle)",
     "exp(-|25 - (x-n_x)^2 - (y-n_y)^2|) + 0.01 in node coordinates"},
    {WeightSource::w4,
     "w4",
     "W4 (waves)",
     "sin(2 pi x/25) sin(2 pi y/25) / 1000 in node coordinates; changes sign, so the grid may fold"},
}};

constexpr std::array<Choice<EllipticMethod>, 3> of_solver{{
    {EllipticMethod::minimiser, "minimiser", "Minimiser", "L-BFGS on the cells; never folds a cell"},
    {EllipticMethod::multigrid,
     "multigrid",
     "Multigrid",
     "For large grids; the minimiser takes over where it stalls"},
    {EllipticMethod::reference, "reference", "Thesis's iteration", "Jacobi and Newton, node by node; slow"},
}};

constexpr std::array<Choice<Combination>, 3> of_combination{{
    {Combination::sum, "sum", "Sum", "Sum of the contributions"},
    {Combination::product, "product", "Product", "Product of 1 + share * contribution"},
    {Combination::largest, "largest", "Maximum", "The largest contribution at each point"},
}};

} // namespace

std::span<const NumberSetting<GridInput>> grid_numbers() {
    return of_grid;
}
std::span<const NumberSetting<RedistributionInput>> redistribution_numbers() {
    return of_redistribution;
}
std::span<const NumberSetting<grid::Region>> region_numbers() {
    return numbers_of_region;
}
bool is_of_harmonic_map(std::string_view id) {
    return id != "adaptation" && id != "orthogonality" && id != "relaxation";
}
std::span<const NumberSetting<EllipticInput>> elliptic_numbers() {
    return of_elliptic;
}
std::span<const NumberSetting<grid::MixSettings>> mix_numbers() {
    return of_mix;
}
std::span<const NumberSetting<TracksInput>> tracks_numbers() {
    return of_tracks;
}
std::span<const NumberSetting<ChainInput>> chain_numbers() {
    return of_chain;
}
std::span<const Choice<TrackDirection>> track_directions() {
    return of_direction;
}
std::span<const Choice<GridMethod>> grid_methods() {
    static const std::vector<Choice<GridMethod>> choices = method_choices();
    return choices;
}
std::span<const Choice<EllipticMethod>> elliptic_solvers() {
    return of_solver;
}
std::span<const Choice<Combination>> combinations() {
    return of_combination;
}
std::span<const Choice<WeightSource>> weight_sources() {
    return of_weight;
}

} // namespace millwright::project
