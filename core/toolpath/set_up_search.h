// Where on the table a part is cut best. The rotary axes swing every point of the part round themselves, the
// further the larger the error of a straight move: the place of the part is the cheapest way to a small one.
#pragma once

#include "core/base/progress.h"
#include "core/grid/grid.h"
#include "core/kinematics/machine_model.h"
#include "core/region/region.h"
#include "core/toolpath/tool.h"

#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace millwright::toolpath {

enum class SetUpGoal {
    error, ///< mean over the moves inside the tracks of the distance from the surface curve, or of what cuts
           ///< (KinematicError), mm
    travel ///< way of the linear axes over the whole path, mm
};

/// The numbers of a place on the table: the workpiece's offset (a, b, c), mm, and how far the part is turned
/// about the vertical through its own origin before, rad, counter-clockwise seen from above.
enum class SetUpParameter { a, b, c, turn };
using SetUpPlace = Eigen::Vector4d;

[[nodiscard]] inline Vec3 offset_of(const SetUpPlace& place) {
    return place.head<3>();
}

/// What is measured of a place.
struct PlaceFigures {
    double cost = std::numeric_limits<double>::infinity(); ///< mm; infinity where out of reach
    /// Largest angle of the tool axis to the one wanted at the nearest point of the surface curve, rad, at
    /// ten times per move (MoveError): a tip that leaves that curve is over ground that faces another way.
    /// Nothing out of reach, for SetUpGoal::travel, which measures no error, and on machines that cannot turn
    /// the tool.
    std::optional<double> axis_max = {};

    friend bool operator==(const PlaceFigures&, const PlaceFigures&) = default;
};

/// What a path over a grid costs as a function of where the workpiece is on the table.
class SetUpCost {
public:
    SetUpCost(region::Region patch,
              kinematics::MachineModel machine,
              bool flipped,
              grid::Grid grid,
              grid::TrackDirection direction,
              SetUpGoal goal,
              Tool tool = {});

    /// Out of reach where a pose cannot be reached inside the axes' limits. Throws Cancelled.
    [[nodiscard]] PlaceFigures figures_at(const SetUpPlace& place, const Progress& progress) const;
    /// The cost alone.
    [[nodiscard]] double at(const SetUpPlace& place, const Progress& progress) const {
        return figures_at(place, progress).cost;
    }
    /// The largest angle on the whole path, looked for until it is known; nothing where there is none of
    /// PlaceFigures. Throws Cancelled.
    [[nodiscard]] std::optional<double> axis_on_path(const SetUpPlace& place, const Progress& progress) const;
    /// As the machine has it, not turned.
    [[nodiscard]] SetUpPlace start() const;

private:
    [[nodiscard]] kinematics::MachineModel machine_at(const SetUpPlace& place) const;
    [[nodiscard]] region::Region patch_at(const SetUpPlace& place) const;

    region::Region patch_;
    kinematics::MachineModel machine_;
    bool flipped_;
    grid::Grid grid_;
    grid::TrackDirection direction_;
    SetUpGoal goal_;
    Tool tool_;
};

/// The figures of many places, in their order; whoever measures them. Throws Cancelled, and Error for those
/// that did not come.
using SetUpCosts = std::function<std::vector<PlaceFigures>(std::span<const SetUpPlace>, const Progress&)>;

/// By the threads of this process; the same bytes on any number of them. Throws Cancelled.
[[nodiscard]] std::vector<PlaceFigures>
figures_at(const SetUpCost& cost, std::span<const SetUpPlace> places, const Progress& progress);

/// Values outside their range throw Defect.
struct SetUpSearchSettings {
    SetUpPlace least{-100.0, -100.0, -100.0, 0.0};
    SetUpPlace most{100.0, 100.0, 100.0, 0.0}; ///< above `least`; an equal turn is not searched
    int places = 5;                            ///< along each of a, b, c that are looked at first, 1 to 50
    int turns = 4;                             ///< the same of the turn where it is searched
    int descent = 120;                         ///< further evaluations at most, 0 to 100 000
};

struct SetUp {
    SetUpPlace place = SetUpPlace::Zero();
    double cost = 0.0;                   ///< mm
    std::optional<double> axis_max = {}; ///< on the whole path (SetUpCost::axis_on_path)
};

struct SetUpSearch {
    SetUp start; ///< as the machine has it, wherever that lies
    SetUp best;  ///< never worse than `start`
    int evaluations = 0;
};

/// The best of a lattice of places, then downhill from there (Nelder and Mead 1965 inside the box, by NLopt).
/// `measure`: who measures the lattice; empty for figures_at(). Deterministic. Throws Cancelled, and what
/// `measure` throws.
[[nodiscard]] SetUpSearch search_set_up(const SetUpCost& cost,
                                        const SetUpSearchSettings& settings,
                                        const Progress& progress,
                                        const SetUpCosts& measure = {});

/// The cost over two of the parameters, the others as in a place.
struct SetUpMap {
    SetUpParameter across = SetUpParameter::a;   ///< which of them the columns are
    SetUpParameter up = SetUpParameter::b;       ///< which the rows are
    std::vector<double> x;                       ///< of the columns, mm or rad
    std::vector<double> y;                       ///< of the rows, mm or rad
    std::vector<double> costs;                   ///< row by row, infinity where out of reach
    std::vector<std::optional<double>> axis_max; ///< the same of PlaceFigures
};

/// `places` each way, 2 to 500, evenly from `settings.least` to `settings.most`. `measure`: who measures
/// them; empty for figures_at(). Throws Cancelled, and what `measure` throws; Defect if `across` is `up`, or
/// is a turn that has no room.
[[nodiscard]] SetUpMap set_up_map(const SetUpCost& cost,
                                  const SetUpPlace& through,
                                  SetUpParameter across,
                                  SetUpParameter up,
                                  int places,
                                  const SetUpSearchSettings& settings,
                                  const Progress& progress,
                                  const SetUpCosts& measure = {});

} // namespace millwright::toolpath
