// Where on the table a part is cut best. The rotary axes swing every point of the part round themselves, the
// further the larger the error of a straight move: the place of the part is the cheapest way to a small one.
#pragma once

#include "core/base/progress.h"
#include "core/geometry/bezier_patch.h"
#include "core/grid/grid.h"
#include "core/kinematics/machine_model.h"

#include <vector>

namespace millwright::toolpath {

enum class SetUpGoal {
    error, ///< mean over the moves inside the tracks of the distance from the surface curve, mm
    travel ///< way of the linear axes over the whole path, mm
};

/// What a path over a grid costs as a function of the workpiece's offset on the table (a, b, c).
class SetUpCost {
public:
    SetUpCost(geometry::BezierPatch patch,
              kinematics::MachineModel machine,
              bool flipped,
              grid::Grid grid,
              grid::TrackDirection direction,
              SetUpGoal goal);

    /// mm; infinity where a pose cannot be reached inside the axes' limits. Throws Cancelled.
    [[nodiscard]] double at(const Vec3& offset, const Progress& progress) const;
    [[nodiscard]] Vec3 offset() const { return machine_.description().workpiece_offset; }

private:
    geometry::BezierPatch patch_;
    kinematics::MachineModel machine_;
    bool flipped_;
    grid::Grid grid_;
    grid::TrackDirection direction_;
    SetUpGoal goal_;
};

/// Values outside their range throw Defect.
struct SetUpSearchSettings {
    Vec3 least{-100.0, -100.0, -100.0}; ///< of the offset, mm
    Vec3 most{100.0, 100.0, 100.0};     ///< above `least`
    int places = 5;                     ///< along each of a, b, c that are looked at first, 1 to 50
    int descent = 120;                  ///< further evaluations at most, 0 to 100 000
};

struct SetUp {
    Vec3 offset = Vec3::Zero(); ///< mm
    double cost = 0.0;          ///< mm
};

struct SetUpSearch {
    SetUp start; ///< as the machine has it, wherever that lies
    SetUp best;  ///< never worse than `start`
    int evaluations = 0;
};

/// The best of a lattice of places, then downhill from there (Nelder and Mead 1965 inside the box, by NLopt).
/// Deterministic. Throws Cancelled.
[[nodiscard]] SetUpSearch
search_set_up(const SetUpCost& cost, const SetUpSearchSettings& settings, const Progress& progress);

/// The cost over two of a, b, c (0, 1, 2), the third as in `offset`.
struct SetUpMap {
    int across = 0;            ///< which of them the columns are
    int up = 1;                ///< which the rows are
    std::vector<double> x;     ///< of the columns, mm
    std::vector<double> y;     ///< of the rows, mm
    std::vector<double> costs; ///< row by row, infinity where out of reach
};

/// `places` each way, 2 to 500, evenly from `settings.least` to `settings.most`. Throws Cancelled; Defect if
/// `across` is `up` or they are none of a, b, c.
[[nodiscard]] SetUpMap set_up_map(const SetUpCost& cost,
                                  const Vec3& offset,
                                  int across,
                                  int up,
                                  int places,
                                  const SetUpSearchSettings& settings,
                                  const Progress& progress);

} // namespace millwright::toolpath
