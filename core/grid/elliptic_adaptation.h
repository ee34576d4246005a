// Adaptation of a grid to the error of a machine by the elliptic functional: the outer loop of
// (Parasilmongkol 1997, KMITL) ch. 4. Measure the error, make a weight of it, let a solver move the nodes,
// measure again, until the error no longer changes. All in the parameters (u, v) of one patch, so that a
// moved node is always on the surface.
#pragma once

#include "core/grid/grid_optimiser.h"
#include "core/grid/weight.h"

#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace millwright::grid {

inline constexpr double any_gap = 1e9; ///< an allowance that allows every gap between tracks

struct EllipticAdaptationSettings {
    TrackDirection direction = TrackDirection::along_v;
    FunctionalWeights functional{.adaptation = 100.0, .orthogonality = 0.0};
    Boundary boundary = Boundary::sliding;
    EllipticMethod method = EllipticMethod::minimiser;
    double relaxation = 0.81;     ///< WW of the reference method
    double tolerance = 1e-3;      ///< of the solver's norm
    int max_iterations = 250;     ///< of the solver, in one round
    int max_rounds = 10;          ///< of the outer loop
    double error_change = 1e-4;   ///< delta: the outer loop ends when the mean changes by less of its start
    int iterations_per_step = 10; ///< of the solver, in one advance()
    ErrorWeightSettings error_weight{};
    double memory = 0.5; ///< share of the earlier rounds in the error density: damps the outer loop
    Sampling sampling = coarse;
    WeightPtr region{}; ///< how much of the weight counts (region.h), in solver coordinates; null: all
    double gap_allowance = any_gap; ///< share by which the track gap of the grid that is taken may grow

    friend bool operator==(const EllipticAdaptationSettings&, const EllipticAdaptationSettings&) = default;
};

/// A weight from the error density of a round's grid (in solver coordinates; on a uniform grid it is the
/// error in mm). Throws Error where it has none.
using WeightOfError = std::function<WeightPtr(const WeightPtr& error_density)>;

/// What an adaptation of nu x nv nodes takes at most, bytes: to be shown before it begins.
[[nodiscard]] std::size_t memory_bytes(EllipticMethod method, int nu, int nv);

/// The harmonic map with what cuts the error most (tests/core/toolpath/elliptic_gain_test.cpp).
[[nodiscard]] EllipticAdaptationSettings harmonic_settings();

/// Measures every ten iterations (every cycle of the multigrid method), so that the grid half-way to a
/// solution can be the best one. If the solver fails, LV becomes a tenth and the round starts again; after
/// three such falls the adaptation ends with the solver's failure. At the end the best grid that fine
/// sampling and the whole path (ErrorModel::on_path) do not find worse than the start, and whose tracks lie
/// as close as they have to, is taken.
class EllipticAdaptation final : public GridOptimiser {
public:
    /// Adapts `start` to the error of `model`, which must outlive this, or to `weight` (in solver
    /// coordinates) where one is given: that is one round after another until the solver converges. Throws
    /// Defect if the settings make no sense, if the reference or the multigrid method gets less than 3 x 3
    /// nodes, or if a
    /// boundary that slides is not straight.
    EllipticAdaptation(const ErrorModel& model,
                       const Grid& start,
                       const EllipticAdaptationSettings& settings,
                       WeightPtr weight = nullptr);

    /// The same to what `weight_of_error` makes of the error of each round.
    EllipticAdaptation(const ErrorModel& model,
                       const Grid& start,
                       const EllipticAdaptationSettings& settings,
                       WeightOfError weight_of_error);

    /// Also throws Error if the weight does.
    bool advance(const Progress& progress) override;

    [[nodiscard]] const OptimiserState& state() const override { return at_.state; }

    /// LV of the round that is running: that of the settings until a solver failed.
    [[nodiscard]] double adaptation() const { return at_.functional.adaptation; }

    /// R_X and R_Y of the thesis's equations (elliptic_equations.h) at the nodes of state().current, in
    /// solver coordinates [nu x nv], with weight and LV of the round that ran last; 0 where a node does not
    /// move. Nothing before the first round, for the harmonic map, which has no such equations, and below 3 x
    /// 3 nodes.
    [[nodiscard]] std::optional<NodeArray> residuals() const override;

private:
    struct Candidate {
        Grid grid;
        ErrorSummary error;
    };
    using CandidatePtr = std::shared_ptr<const Candidate>;

    /// Everything that a step changes; a cancelled step is forgotten with its copy.
    struct Position {
        OptimiserState state;
        Grid round_start;
        double round_start_error = 0.0;                 ///< mean
        std::optional<ErrorSummary> coarse_start{};     ///< by the settings' sampling; nothing before a step
        double coarse_best = 0.0;                       ///< mean of `state.best`, likewise
        std::vector<MoveError> moves{};                 ///< of the last complete grid
        WeightPtr density{};                            ///< the error density, remembered from round to round
        WeightPtr round_weight{};                       ///< null between two rounds
        WeightPtr last_weight{};                        ///< of the round that runs or ran last
        std::shared_ptr<const EllipticSolver> solver{}; ///< null between two rounds
        std::vector<CandidatePtr> candidates{};         ///< none dominated by one before it
        std::vector<double> too_wide{};                 ///< the means of those whose tracks lie too far apart
        double widest_gap = std::numeric_limits<double>::infinity(); ///< mm on the surface
        FunctionalWeights functional{};
        int falls = 0;
        std::string weight_warning{}; ///< as OptimiserState::warning, of the weight alone
        std::string unsolved{};       ///< of the last round, a sentence; empty: converged
        int iterations_before = 0;    ///< done before the solver started
        OptimiserStatus ending = OptimiserStatus::running; ///< how it will end, once confirmed
    };

    /// Whether the functional has an LV.
    [[nodiscard]] bool has_adaptation() const { return settings_.method != EllipticMethod::harmonic; }
    [[nodiscard]] WeightPtr error_weight(Position& at) const;
    [[nodiscard]] WeightPtr weight_of_round(Position& at) const;
    [[nodiscard]] std::unique_ptr<EllipticSolver> new_solver(Position& at) const;
    [[nodiscard]] double share_done(const Position& at) const;
    void measure_start(Position& at, const Progress& progress) const;
    void step(Position& at, const Progress& progress) const;
    [[nodiscard]] NodeArray parameters_of(const NodeArray& nodes) const;
    void take(Position& at, const NodeArray& nodes, const Progress& progress) const;
    void fall(Position& at, SolverStatus failure) const;
    void end_round(Position& at, SolverStatus solved) const;
    void confirm(Position& at, const Progress& progress) const;
    void keep(Position& at, const Grid& grid) const;
    void choose(Position& at, const Progress& progress) const;
    [[nodiscard]] ErrorSummary finely(const Grid& grid, const Progress& progress) const;

    const ErrorModel& model_;
    EllipticAdaptationSettings settings_;
    WeightPtr weight_; ///< null: from the error
    WeightOfError weight_of_error_;
    Grid start_;
    Position at_;
};

} // namespace millwright::grid
