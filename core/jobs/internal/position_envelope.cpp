#include "core/jobs/internal/position_envelope.h"

#include "core/base/units.h"
#include "core/kinematics/machine_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::jobs::internal {

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
