// What is left against the part that is wanted: at each of its points, how far along the normal the material
// goes on above it (excess) or ends below it (gouge). The lines of the field only say which moves can have
// made the surface there; the figure is that of the tool's true positions on the machine's own motion.
// Lengths mm.
#pragma once

#include "core/simulation/simulation.h"

#include <optional>
#include <span>
#include <vector>

namespace millwright::simulation {

/// A point of the surface of the part, and the area that it represents.
struct PartPoint {
    Vec3 point = Vec3::Zero();
    Vec3 normal = Vec3::UnitZ(); ///< unit, out of the material
    double area = 0.0;           ///< mm^2
};

struct Deviation {
    /// Along the normal: above 0 excess, below 0 gouge. Of a gouge whose side is less than half as far away,
    /// as at an edge of the part, the distance to that.
    double height = 0.0;
    int block = -1;        ///< of the program, that cuts deepest there; -1: none, or not known
    bool at_least = false; ///< all material around was removed: the gouge may be deeper than the stock was
};

/// One per point. Where no move comes near, the height is that of the stock along the normal; a point outside
/// of it has its distance to it, below 0. A point without material within a cell of the field is a gouge, at
/// least as deep as the next material is far. `found` is what simulate() gave for `input`. Throws Cancelled.
[[nodiscard]] std::vector<Deviation> deviations(const SimulationInput& input,
                                                const Simulation& found,
                                                std::span<const PartPoint> points,
                                                const Progress& progress);

/// The same of the field of a Simulator that has cut the whole program, from `first_block` on.
[[nodiscard]] std::vector<Deviation> deviations(const SimulationInput& input,
                                                const DexelField& field,
                                                int first_block,
                                                std::span<const PartPoint> points,
                                                const Progress& progress);

/// The worst point of one kind.
struct WorstDeviation {
    double height = 0.0;
    int block = -1;
    Vec3 point = Vec3::Zero();
    bool at_least = false; ///< as of Deviation
};

struct ComparisonSummary {
    double area = 0.0;                    ///< of all points
    double within = 0.0;                  ///< share of it within the tolerance, 0 to 1
    double gouged = 0.0, in_excess = 0.0; ///< shares beyond it
    std::optional<WorstDeviation> gouge, excess;
};

/// Throws Defect unless there is a deviation for each point.
[[nodiscard]] ComparisonSummary
summary_of(std::span<const PartPoint> points, std::span<const Deviation> deviations, double tolerance);

} // namespace millwright::simulation
