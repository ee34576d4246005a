#include "core/toolpath/set_up_search.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/base/parallel.h"
#include "core/toolpath/fixed_axis.h"
#include "core/toolpath/kinematic_error.h"
#include "core/toolpath/sequencing.h"
#include "core/toolpath/zigzag.h"

#include <nlopt.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace millwright::toolpath {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

void check(const SetUpSearchSettings& settings) {
    expects(is_finite(settings.least) && is_finite(settings.most), "the box of a set-up is finite");
    expects((settings.least.array() < settings.most.array()).all(), "the box of a set-up has a volume");
    expects(settings.places >= 1 && settings.places <= 50, "1 to 50 places are looked at along each axis");
    expects(settings.descent >= 0 && settings.descent <= 100'000, "a descent has 0 to 100 000 evaluations");
}

/// Evenly inside the box, half a step from its sides.
std::vector<Vec3> lattice(const SetUpSearchSettings& settings) {
    const Vec3 step = (settings.most - settings.least) / settings.places;
    std::vector<Vec3> found;
    for (int i = 0; i < settings.places; ++i) {
        for (int j = 0; j < settings.places; ++j) {
            for (int k = 0; k < settings.places; ++k) {
                found.push_back(settings.least + step.cwiseProduct(Vec3(i + 0.5, j + 0.5, k + 0.5)));
            }
        }
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

/// Downhill from `best`, which it makes better; returns the number of evaluations.
int descend(const SetUpCost& cost,
            const SetUpSearchSettings& settings,
            SetUp& best,
            const Progress& progress) {
    constexpr double out_of_reach = 1e30; // a simplex compares numbers
    constexpr double settled_mm = 1e-3;
    int evaluations = 0;
    nlopt::opt simplex(nlopt::LN_NELDERMEAD, 3);
    const nlopt::vfunc value = [](const std::vector<double>& at, std::vector<double>&, void* data) {
        return (*static_cast<const std::function<double(const std::vector<double>&)>*>(data))(at);
    };
    std::function<double(const std::vector<double>&)> measured = [&](const std::vector<double>& at) {
        if (progress.cancelled()) {
            throw nlopt::forced_stop(); // the only way out through the library; thrown again below
        }
        const Vec3 offset(at[0], at[1], at[2]);
        const double found = cost.at(offset, Progress());
        ++evaluations;
        progress.report(static_cast<double>(evaluations) / settings.descent);
        if (found < best.cost) {
            best = {offset, found};
        }
        return std::min(found, out_of_reach);
    };
    simplex.set_min_objective(value, &measured);
    simplex.set_lower_bounds({settings.least.x(), settings.least.y(), settings.least.z()});
    simplex.set_upper_bounds({settings.most.x(), settings.most.y(), settings.most.z()});
    const Vec3 step = (settings.most - settings.least) / (2.0 * settings.places);
    simplex.set_initial_step({step.x(), step.y(), step.z()});
    simplex.set_maxeval(settings.descent);
    simplex.set_xtol_abs(settled_mm);
    const Vec3 from = best.offset.cwiseMax(settings.least).cwiseMin(settings.most);
    std::vector<double> at{from.x(), from.y(), from.z()};
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

SetUpCost::SetUpCost(geometry::BezierPatch patch,
                     kinematics::MachineModel machine,
                     bool flipped,
                     grid::Grid grid,
                     grid::TrackDirection direction,
                     SetUpGoal goal)
    : patch_(std::move(patch)), machine_(std::move(machine)), flipped_(flipped), grid_(std::move(grid)),
      direction_(direction), goal_(goal) {}

double SetUpCost::at(const Vec3& offset, const Progress& progress) const {
    progress.check();
    const kinematics::MachineModel machine = machine_.with_workpiece_offset(offset);
    try {
        const AxisPath axes =
            sequence(machine, on_machine(machine, zigzag(patch_, grid_, direction_, flipped_)));
        if (goal_ == SetUpGoal::travel) {
            return linear_travel(machine, axes);
        }
    } catch (const Error&) { // a pose that cannot be reached
        return infinity;
    }
    const KinematicError error(patch_, machine, flipped_);
    return grid::summary(measure(error, grid_, direction_, grid::coarse, progress)).mean;
}

SetUpSearch
search_set_up(const SetUpCost& cost, const SetUpSearchSettings& settings, const Progress& progress) {
    check(settings);
    SetUpSearch found;
    found.start = {cost.offset(), cost.at(cost.offset(), progress)};
    found.best = found.start;
    found.evaluations = 1;
    const std::vector<Vec3> places = lattice(settings);
    const double scan = static_cast<double>(places.size());
    const double share = scan / (scan + settings.descent);
    for (const Vec3& offset : places) {
        const double here = cost.at(offset, progress);
        if (here < found.best.cost) {
            found.best = {offset, here};
        }
        progress.report(share * found.evaluations / scan, "Searching the set-up");
        ++found.evaluations;
    }
    if (settings.descent > 0) {
        found.evaluations += descend(cost, settings, found.best, progress.part(share, 1.0));
    }
    return found;
}

SetUpMap set_up_map(const SetUpCost& cost,
                    const Vec3& offset,
                    int across,
                    int up,
                    int places,
                    const SetUpSearchSettings& settings,
                    const Progress& progress) {
    check(settings);
    expects(across >= 0 && across < 3 && up >= 0 && up < 3 && across != up, "a map is over two of a, b, c");
    expects(places >= 2 && places <= 500, "a map has 2 to 500 places each way");
    SetUpMap map{across, up, {}, {}, {}};
    for (int n = 0; n < places; ++n) {
        const double t = static_cast<double>(n) / (places - 1);
        map.x.push_back(mix(settings.least[across], settings.most[across], t));
        map.y.push_back(mix(settings.least[up], settings.most[up], t));
    }
    for (const double y : map.y) {
        for (const double x : map.x) {
            Vec3 here = offset;
            here[across] = x;
            here[up] = y;
            map.costs.push_back(cost.at(here, progress));
            progress.report(static_cast<double>(map.costs.size()) / (places * places), "Mapping the set-up");
        }
    }
    return map;
}

} // namespace millwright::toolpath
