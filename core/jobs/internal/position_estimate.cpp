#include "core/jobs/internal/position_estimate.h"

#include "core/base/units.h"
#include "core/kinematics/machine_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::jobs::internal {

namespace {

constexpr double on_path_within = 0.5;         // mm: chords of arcs, rounded reports
constexpr std::size_t most_moves_ahead = 5000; // that a controller can have, with short moves

/// Of the point of a move that is nearest to `at`, 0 to 1.
double nearest_part(const Vec3& at, const Vec3& from, const Vec3& to) {
    const Vec3 way = to - from;
    const double length = way.squaredNorm();
    return length > 0.0 ? std::clamp((at - from).dot(way) / length, 0.0, 1.0) : 0.0;
}

} // namespace

PathEstimate::PathEstimate(std::vector<ProgramCheck::MoveEnd> path, const Vec3& start)
    : path_(std::move(path)), start_(start) {}

double PathEstimate::length_of(std::size_t move) const {
    return (path_[move].at - begin_of(move)).norm();
}

/// A line may have many moves: the pieces of an arc, a canned cycle.
double PathEstimate::fraction_of_line(std::size_t move, double part) const {
    const int line = path_[move].line;
    double done = part * length_of(move);
    double whole = length_of(move);
    for (std::size_t n = move; n > 0 && path_[n - 1].line == line; --n) {
        done += length_of(n - 1);
        whole += length_of(n - 1);
    }
    for (std::size_t n = move + 1; n < path_.size() && path_[n].line == line; ++n) {
        whole += length_of(n);
    }
    return whole > 0.0 ? done / whole : 0.0;
}

PathPlace PathEstimate::place_at(const Vec3& at, int first, int last) {
    while (next_ < path_.size() && path_[next_].line < first) {
        ++next_;
    }
    const std::size_t end = std::min(path_.size(), next_ + most_moves_ahead);
    for (std::size_t n = next_; n < end && path_[n].line <= last; ++n) {
        const Vec3& from = begin_of(n);
        const double part = nearest_part(at, from, path_[n].at);
        if ((at - from - part * (path_[n].at - from)).norm() <= on_path_within) {
            const PathPlace found{path_[n].line, fraction_of_line(n, part)};
            const bool is_behind =
                found.line == place_.line && found.fraction < place_.fraction && n == next_;
            place_ = is_behind ? place_ : found;
            next_ = n;
            break;
        }
    }
    if (place_.line < first) {
        place_ = {first, 0.0};
    }
    return place_;
}

namespace {

constexpr double clearance = 1.0;                     // mm: more than any controller rounds or blends
constexpr double clearance_angle = from_degrees(1.0); // rad
constexpr double longest_doubt = 0.25;                // s: more than two reports

/// LinuxCNC says that a tool's length is in force, and not how long it is.
bool knows_tool_length(const drivers::DriverStatus& before,
                       const std::vector<drivers::StoredOffset>& offsets) {
    return before.modes.find("G43") == std::string::npos ||
           std::ranges::any_of(offsets,
                               [](const drivers::StoredOffset& offset) { return offset.name == "TLO"; });
}

} // namespace

PositionEnvelope::PositionEnvelope(const ProgramCheck& found,
                                   std::vector<program::ProgramAxis> axes,
                                   const drivers::DriverStatus& before,
                                   const std::vector<drivers::StoredOffset>& offsets)
    : axes_(std::move(axes)), doubt_(before.position_doubt) {
    if (found.errors.empty() && !found.probes && !before.modes.empty() && !offsets.empty() &&
        knows_tool_length(before, offsets)) {
        found_ = found;
    }
}

/// At a tool change a person has the machine. The zero that it sets there moves the box, and where the
/// machine is left belongs to it.
bool PositionEnvelope::leaves_watch(const drivers::DriverStatus& status) {
    if (status.tool_change) {
        offset_before_ = offset_before_.size() == 0 ? status.work_offset : offset_before_;
        since_.reset();
        return true;
    }
    if (offset_before_.size() == 0 || !found_) {
        return false;
    }
    const kinematics::AxisPositions before = std::exchange(offset_before_, {});
    for (std::size_t n = 0; n < axes_.size() && std::cmp_less(n, status.position.size()); ++n) {
        const auto letter = std::ranges::find(gcode::axis_letters, axes_[n].letter);
        const auto index = static_cast<std::size_t>(letter - gcode::axis_letters.begin());
        const auto axis = static_cast<Eigen::Index>(n);
        const bool known = before.size() == status.work_offset.size();
        const double moved = known ? status.work_offset[axis] - before[axis] : 0.0;
        ProgramCheck::Range& range = found_->ranges[index];
        range.min = std::min({range.min, range.min + moved, status.position[axis]});
        range.max = std::max({range.max, range.max + moved, status.position[axis]});
    }
    return false;
}

std::string PositionEnvelope::watch(const drivers::DriverStatus& status, double now) {
    if (leaves_watch(status)) {
        return {};
    }
    const bool moves =
        status.state == drivers::DriverState::running && status.activity == drivers::Activity::program;
    const bool rests = status.state == drivers::DriverState::idle;
    if (!found_ || status.position_doubt != doubt_ || !(moves || rests)) {
        return {};
    }
    std::string where = beyond(status);
    if (where.empty()) {
        since_.reset();
        return {};
    }
    since_ = since_.value_or(now);
    return rests || now - *since_ > longest_doubt ? where : std::string();
}

std::string PositionEnvelope::beyond(const drivers::DriverStatus& status) const {
    for (std::size_t n = 0; n < axes_.size() && std::cmp_less(n, status.position.size()); ++n) {
        const program::ProgramAxis& axis = axes_[n];
        const auto letter = std::ranges::find(gcode::axis_letters, axis.letter);
        const auto index = static_cast<std::size_t>(letter - gcode::axis_letters.begin());
        const std::optional<double> start = found_->start[index];
        if (!start) {
            continue;
        }
        const bool rotary = axis.kind == kinematics::AxisKind::rotary;
        const double at = status.position[static_cast<Eigen::Index>(n)];
        const double low = std::min(*start, found_->ranges[index].min);
        const double high = std::max(*start, found_->ranges[index].max);
        const double room = rotary ? clearance_angle : clearance;
        if (at < low - room || at > high + room) {
            const auto shown = [rotary](double value) { return rotary ? to_degrees(value) : value; };
            return fmt::format("the machine reports {} {:.3f}, but the program never goes beyond {} {:.3f} "
                               "(machine coordinates): a line was altered on its way to the controller",
                               axis.letter,
                               shown(at),
                               axis.letter,
                               shown(at < low ? low : high));
        }
    }
    return {};
}

} // namespace millwright::jobs::internal
