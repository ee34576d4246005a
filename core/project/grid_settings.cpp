// What the numbers and choices of the grids say of themselves.
#include "core/project/settings.h"

#include <array>

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
     "Grid nodes along u, the boundary's included",
     2,
     most_nodes_a_side,
     0,
     field<&GridInput::nu>},
    {"nv",
     "Nodes along v",
     "",
     "Grid nodes along v, the boundary's included",
     2,
     most_nodes_a_side,
     0,
     field<&GridInput::nv>},
}};

constexpr std::array<NumberSetting<RedistributionInput>, 2> of_redistribution{{
    {"floor",
     "Floor",
     "",
     "What is added to sqrt(e) / h everywhere, in its means: the larger, the evener the nodes",
     1e-3,
     1e3,
     3,
     field<&RedistributionInput::floor>},
    {"smoothing_passes",
     "Smoothing",
     "",
     "Binomial passes over sqrt(e) / h along each track",
     0,
     100,
     0,
     field<&RedistributionInput::smoothing_passes>},
}};

constexpr std::array<NumberSetting<grid::Region>, 1> numbers_of_region{{
    {"border_mm",
     "Border",
     "mm",
     "Width on the surface, outside of the outline, over which the adaptation fades",
     0.0,
     1e3,
     2,
     field<&grid::Region::border_mm>},
}};

constexpr std::array<NumberSetting<EllipticInput>, 8> of_elliptic{{
    {"adaptation",
     "Adaptation",
     "",
     "LV: how strongly the weight pulls cells together, against smoothness",
     0.0,
     1e4,
     2,
     field<&EllipticInput::adaptation>},
    {"orthogonality",
     "Orthogonality",
     "",
     "LO: how strongly grid lines are kept at right angles, against smoothness",
     0.0,
     1e4,
     2,
     field<&EllipticInput::orthogonality>},
    {"relaxation",
     "Relaxation",
     "",
     "WW of the thesis's iteration: a node keeps this share of its old position; the other solvers have none",
     0.0,
     0.999,
     3,
     field<&EllipticInput::relaxation>},
    {"tolerance",
     "Residual tolerance",
     "",
     "A round ends when half the largest |R_X| + |R_Y| of a node is not above it",
     1e-12,
     1e3,
     6,
     field<&EllipticInput::tolerance>},
    {"max_iterations",
     "Iterations per round",
     "",
     "A round ends after so many iterations of the solver at the latest",
     1,
     100000,
     0,
     field<&EllipticInput::max_iterations>},
    {"max_rounds",
     "Rounds",
     "",
     "How often the error is measured anew and turned into the weight",
     1,
     1000,
     0,
     field<&EllipticInput::max_rounds>},
    {"error_change",
     "Settled change",
     "",
     "Delta of the outer loop: it ends when a round changes the mean error by no more than this share of the "
     "mean error at the start",
     0.0,
     1.0,
     6,
     field<&EllipticInput::error_change>},
    {"iterations_per_step",
     "Refresh interval",
     "",
     "Iterations per refresh of an adaptation that is watched; the result is the same",
     1,
     10000,
     0,
     field<&EllipticInput::iterations_per_step>},
}};

constexpr std::array<NumberSetting<MixSettings>, 7> of_mix{{
    {"error",
     "Error share",
     "",
     "How much the measured error counts; it is divided by its largest and raised to the power 0.7",
     0.0,
     1e3,
     2,
     field<&MixSettings::error>},
    {"curvature",
     "Curvature share",
     "",
     "How much sqrt(k1^2 + k2^2) counts, divided by its largest",
     0.0,
     1e3,
     2,
     field<&MixSettings::curvature>},
    {"painted",
     "Paint share",
     "",
     "How much what is painted counts",
     0.0,
     1e3,
     2,
     field<&MixSettings::painted>},
    {"expression",
     "Formula share",
     "",
     "How much the value of the formula counts, as it is",
     0.0,
     1e3,
     2,
     field<&MixSettings::expression>},
    {"smoothing_passes",
     "Smoothing",
     "",
     "Passes of the average over nine neighbours; there are two places a cell each way",
     0,
     100,
     0,
     field<&MixSettings::smoothing_passes>},
    {"low", "Lowest weight", "", "The weight is nowhere below", 1e-6, 1e3, 3, field<&MixSettings::low>},
    {"high", "Highest weight", "", "The weight is nowhere above", 1e-6, 1e6, 3, field<&MixSettings::high>},
}};

constexpr std::array<NumberSetting<TracksInput>, 4> of_tracks{{
    {"lattice",
     "Candidates",
     "",
     "Lattice points per track that its nodes are chosen from; 0 takes max(160, 4 n) for n nodes",
     0,
     4000,
     0,
     field<&TracksInput::lattice>},
    {"error_exponent",
     "Error exponent",
     "",
     "p of the cost of a move, length * error^p: the larger, the more the worst moves count",
     1.0,
     16.0,
     1,
     field<&TracksInput::error_exponent>},
    {"axis_weight",
     "Tool-axis weight",
     "mm/deg",
     "How much error one degree between tool axis and surface normal counts as",
     0.0,
     100.0,
     3,
     field<&TracksInput::axis_weight>},
    {"polish_sweeps",
     "Polishing sweeps",
     "",
     "How often each node is moved on its own after the best lattice points are found",
     0,
     1000,
     0,
     field<&TracksInput::polish_sweeps>},
}};

constexpr std::array<NumberSetting<ChainInput>, 3> of_chain{{
    {"first_iterations",
     "First iterations",
     "",
     "Of all nodes at once at the error exponent of the tracks, at most",
     0,
     10000,
     0,
     field<&ChainInput::first_iterations>},
    {"later_iterations",
     "Later iterations",
     "",
     "The same at each of the exponents 4, 6, 8, 16 and 32, which lower the worst moves; 0 leaves them out",
     0,
     10000,
     0,
     field<&ChainInput::later_iterations>},
    {"gap_percent",
     "Track gap",
     "%",
     "By how much the largest distance of neighbouring tracks may grow; the scallop grows with its square",
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

constexpr std::array<Choice<GridMethod>, 6> of_method{{
    {GridMethod::uniform, "uniform", "Uniform", "Equal parameter steps, no adaptation"},
    {GridMethod::redistribution,
     "redistribution",
     "1-D redistribution",
     "On each track alone, equal shares of sqrt(e) / h"},
    {GridMethod::elliptic,
     "elliptic",
     "Elliptic",
     "Brackbill and Saltzman's elliptic grid, weighted by the error"},
    {GridMethod::harmonic,
     "harmonic",
     "Harmonic map",
     "The weight as a metric along the tracks, which come together less than their nodes"},
    {GridMethod::tracks,
     "tracks",
     "Track optimiser",
     "The nodes of each track placed so that its error is least"},
    {GridMethod::chain,
     "chain",
     "Whole chain",
     "Tracks chosen, their nodes placed, then all nodes moved at once; takes its time"},
}};

constexpr std::array<Choice<WeightSource>, 7> of_weight{{
    {WeightSource::error, "error", "Error density", "The measured error, e/h^2, scaled and smoothed"},
    {WeightSource::expression,
     "expression",
     "Expression",
     "A formula of the place, the surface and the error"},
    {WeightSource::mixed, "mixed", "Mixed", "Error, curvature, paint and formula, each with its share"},
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
    {EllipticMethod::minimiser, "minimiser", "Minimiser", "L-BFGS on the cells; never folds one"},
    {EllipticMethod::multigrid,
     "multigrid",
     "Multigrid",
     "For many nodes; where it stalls the minimiser goes on"},
    {EllipticMethod::reference, "reference", "Thesis's iteration", "Jacobi and Newton, node by node; slow"},
}};

constexpr std::array<Choice<Combination>, 3> of_combination{{
    {Combination::sum, "sum", "Sum", "The reasons added"},
    {Combination::product, "product", "Product", "Of 1 + share * reason"},
    {Combination::largest, "largest", "Largest", "The reason that counts most there"},
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
    return of_method;
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
