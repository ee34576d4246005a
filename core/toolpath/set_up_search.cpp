#include "core/toolpath/set_up_search.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/base/parallel.h"
#include "core/toolpath/kinematic_error.h"
#include "core/toolpath/sequencing.h"
#include "core/toolpath/tool_poses.h"
#include "core/toolpath/zigzag.h"

#include <Eigen/Geometry>
#include <nlopt.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <utility>

namespace millwright::toolpath {

namespace {

void check(const SetUpSearchSettings& settings) {
    const auto least = settings.least.array();
    const auto most = settings.most.array();
    expects(least.allFinite() && most.allFinite(), "the box of a set-up is finite");
    expects((least.head<3>() < most.head<3>()).all() && least[3] <= most[3],
            "the box of a set-up has a volume");
    expects(settings.places >= 1 && settings.places <= 50, "1 to 50 positions are searched along each axis");
    expects(settings.turns >= 1 && settings.turns <= 50, "1 to 50 turns are searched");
    expects(settings.descent >= 0 && settings.descent <= 100'000, "a descent has 0 to 100 000 evaluations");
}

bool turns(const SetUpSearchSettings& settings) {
    return settings.least[3] < settings.most[3];
}

/// How many places are looked at along each parameter.
Eigen::Array4i counts_of(const SetUpSearchSettings& settings) {
    return {settings.places, settings.places, settings.places, turns(settings) ? settings.turns : 1};
}

/// Evenly inside the box, half a step from its sides.
std::vector<SetUpPlace> lattice(const SetUpSearchSettings& settings) {
    const Eigen::Array4i counts = counts_of(settings);
    const Eigen::Array4d step = (settings.most - settings.least).array() / counts.cast<double>();
    std::vector<SetUpPlace> found;
    for (int n = 0; n < counts.prod(); ++n) {
        int rest = n;
        Eigen::Array4d at;
        for (int k = 3; k >= 0; --k) {
            at[k] = rest % counts[k] + 0.5;
            rest /= counts[k];
        }
        found.emplace_back(settings.least.array() + step * at);
    }
    return found;
}

double linear_travel(const kinematics::MachineModel& machine, const AxisPath& axes) {
    double sum = 0.0;
    for (std::size_t n = 1; n < axes.positions.size(); ++n) {
        double square = 0.0;
        for (const int axis : machine.linear_axes()) {
            square += millwright::square(axes.positions[n][axis] - axes.positions[n - 1][axis]);
        }
        sum += std::sqrt(square);
    }
    return sum;
}

std::vector<PlaceFigures> measured(const SetUpCost& cost,
                                   std::span<const SetUpPlace> places,
                                   const SetUpCosts& measure,
                                   const Progress& progress) {
    std::vector<PlaceFigures> figures =
        measure ? measure(places, progress) : figures_at(cost, places, progress);
    expects(figures.size() == places.size(), "each place has a cost");
    return figures;
}

/// Downhill from `best`, which it makes better; returns the number of evaluations.
int descend_to_best(const SetUpCost& cost,
                    const SetUpSearchSettings& settings,
                    SetUp& best,
                    const Progress& progress) {
    constexpr double out_of_reach = 1e30; // a simplex compares numbers
    constexpr double settled = 1e-3;      // mm, and a thousandth of a degree or so
    const int dimensions = turns(settings) ? 4 : 3;
    constexpr const char* downhill = "Descending from the best position";
    progress.report(0.0, downhill);
    int evaluations = 0;
    nlopt::opt simplex(nlopt::LN_NELDERMEAD, static_cast<unsigned>(dimensions));
    const nlopt::vfunc value = [](const std::vector<double>& at, std::vector<double>&, void* data) {
        return (*static_cast<const std::function<double(const std::vector<double>&)>*>(data))(at);
    };
    std::function<double(const std::vector<double>&)> value_at = [&](const std::vector<double>& at) {
        if (progress.cancelled()) {
            throw nlopt::forced_stop(); // the only way out through the library; thrown again below
        }
        SetUpPlace place = best.place;
        std::copy(at.begin(), at.end(), place.begin());
        const PlaceFigures found = cost.figures_at(place, Progress());
        ++evaluations;
        progress.report(static_cast<double>(evaluations) / settings.descent, downhill);
        if (found.cost < best.cost) {
            best = {place, found.cost};
        }
        return std::min(found.cost, out_of_reach);
    };
    const auto numbers = [&](const SetUpPlace& place) {
        return std::vector<double>(place.data(), place.data() + dimensions);
    };
    simplex.set_min_objective(value, &value_at);
    simplex.set_lower_bounds(numbers(settings.least));
    simplex.set_upper_bounds(numbers(settings.most));
    const Eigen::Array4d half_steps = 2.0 * counts_of(settings).cast<double>();
    simplex.set_initial_step(numbers((settings.most - settings.least).array() / half_steps));
    simplex.set_maxeval(settings.descent);
    simplex.set_xtol_abs(settled);
    std::vector<double> at = numbers(best.place.cwiseMax(settings.least).cwiseMin(settings.most));
    double reached = 0.0;
    try {
        simplex.optimize(at, reached);
    } catch (const nlopt::forced_stop&) {
    } catch (const nlopt::roundoff_limited&) { // as near as numbers go
    }
    progress.check();
    return evaluations;
}

} // namespace

SetUpCost::SetUpCost(region::Region patch,
                     kinematics::MachineModel machine,
                     bool flipped,
                     grid::Grid grid,
                     grid::TrackDirection direction,
                     SetUpGoal goal,
                     Tool tool)
    : patch_(std::move(patch)), machine_(std::move(machine)), flipped_(flipped), grid_(std::move(grid)),
      direction_(direction), goal_(goal), tool_(std::move(tool)) {}

SetUpPlace SetUpCost::start() const {
    SetUpPlace place = SetUpPlace::Zero();
    place.head<3>() = machine_.description().workpiece_offset;
    return place;
}

kinematics::MachineModel SetUpCost::machine_at(const SetUpPlace& place) const {
    return machine_.with_workpiece_offset(offset_of(place));
}

region::Region SetUpCost::patch_at(const SetUpPlace& place) const {
    return exactly_equal(place[3], 0.0) ? patch_ : patch_.turned(place[3]);
}

std::optional<double> SetUpCost::axis_on_path(const SetUpPlace& place, const Progress& progress) const {
    if (goal_ == SetUpGoal::travel || machine_.rotary_axes().empty()) {
        return std::nullopt;
    }
    const KinematicError error(patch_at(place), machine_at(place), flipped_, tool_);
    const double largest = error.on_path(grid_, direction_, progress).axis_max;
    return std::isfinite(largest) ? std::optional(largest) : std::nullopt;
}

PlaceFigures SetUpCost::figures_at(const SetUpPlace& place, const Progress& progress) const {
    progress.check();
    const kinematics::MachineModel machine = machine_at(place);
    const region::Region patch = patch_at(place);
    Toolpath contacts =
        zigzag(patch, grid_, direction_, flipped_); // what is wrong with it is so at every place
    try {
        const AxisPath axes = sequence(machine, with_tool(patch, machine, tool_, std::move(contacts)));
        if (goal_ == SetUpGoal::travel) {
            return {linear_travel(machine, axes)};
        }
    } catch (const Error&) { // a pose that cannot be reached
        return {};
    }
    const KinematicError error(patch, machine, flipped_, tool_);
    const grid::ErrorSummary found = grid::summary(measure(error, grid_, direction_, grid::coarse, progress));
    const bool turns = std::isfinite(found.mean) && !machine.rotary_axes().empty();
    return {found.mean, turns ? std::optional(found.axis_max) : std::nullopt};
}

std::vector<PlaceFigures>
figures_at(const SetUpCost& cost, std::span<const SetUpPlace> places, const Progress& progress) {
    std::vector<PlaceFigures> figures(places.size());
    std::atomic<std::size_t> done = 0;
    parallel_for(std::ssize(places), 1, [&](std::ptrdiff_t n) {
        const auto at = static_cast<std::size_t>(n);
        figures[at] = cost.figures_at(places[at], progress.part(0.0, 0.0));
        progress.report(static_cast<double>(++done) / static_cast<double>(places.size()));
    });
    return figures;
}

SetUpSearch search_set_up(const SetUpCost& cost,
                          const SetUpSearchSettings& settings,
                          const Progress& progress,
                          const SetUpCosts& measure) {
    check(settings);
    SetUpSearch found;
    const PlaceFigures start = cost.figures_at(cost.start(), progress);
    found.start = {cost.start(), start.cost};
    found.best = found.start;
    found.evaluations = 1;
    const std::vector<SetUpPlace> places = lattice(settings);
    const double scan = static_cast<double>(places.size());
    const double share = scan / (scan + settings.descent);
    progress.report(0.0, "Searching for the best set-up");
    const std::vector<PlaceFigures> figures = measured(cost, places, measure, progress.part(0.0, share));
    for (std::size_t n = 0; n < places.size(); ++n) {
        if (figures[n].cost < found.best.cost) {
            found.best = {places[n], figures[n].cost};
        }
    }
    found.evaluations += static_cast<int>(places.size());
    if (settings.descent > 0) {
        found.evaluations += descend_to_best(cost, settings, found.best, progress.part(share, 1.0));
    }
    constexpr double rounding = 1e-6; // of the cost
    if (!(found.best.cost < (1.0 - rounding) * found.start.cost)) {
        found.best = found.start;
    }
    const Progress rest = progress.part(1.0, 1.0);
    found.start.axis_max = cost.axis_on_path(found.start.place, rest);
    found.best.axis_max = cost.axis_on_path(found.best.place, rest);
    return found;
}

SetUpMap set_up_map(const SetUpCost& cost,
                    const SetUpPlace& through,
                    SetUpParameter across,
                    SetUpParameter up,
                    int places,
                    const SetUpSearchSettings& settings,
                    const Progress& progress,
                    const SetUpCosts& measure) {
    check(settings);
    const bool of_turn = across == SetUpParameter::turn || up == SetUpParameter::turn;
    expects(across != up && (!of_turn || turns(settings)), "a map is over two parameters with a range");
    expects(places >= 2 && places <= 500, "a map has 2 to 500 positions in each direction");
    const auto column = static_cast<Eigen::Index>(across);
    const auto row = static_cast<Eigen::Index>(up);
    SetUpMap map{across, up, {}, {}, {}, {}};
    for (int n = 0; n < places; ++n) {
        const double t = static_cast<double>(n) / (places - 1);
        map.x.push_back(mix(settings.least[column], settings.most[column], t));
        map.y.push_back(mix(settings.least[row], settings.most[row], t));
    }
    std::vector<SetUpPlace> over;
    over.reserve(map.x.size() * map.y.size());
    for (const double y : map.y) {
        for (const double x : map.x) {
            SetUpPlace& here = over.emplace_back(through);
            here[column] = x;
            here[row] = y;
        }
    }
    progress.report(0.0, "Mapping the set-up");
    for (const PlaceFigures& figures : measured(cost, over, measure, progress)) {
        map.costs.push_back(figures.cost);
        map.axis_max.push_back(figures.axis_max);
    }
    return map;
}

} // namespace millwright::toolpath
