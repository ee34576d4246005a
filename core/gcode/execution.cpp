#include "core/gcode/execution.h"

#include "core/base/error.h"
#include "core/base/numbers.h"

#include <algorithm>
#include <limits>

namespace millwright::gcode {

namespace {

/// The last entry at or before `step`; the first one is of step 0.
template <class Entry> const Entry& last_until(const std::vector<Entry>& entries, Step step) {
    const auto after = std::upper_bound(
        entries.begin(), entries.end(), step, [](Step s, const Entry& entry) { return s < entry.step; });
    expects(after != entries.begin(), "what is in force is known from the first step on");
    return *(after - 1);
}

bool same(const AxisValues& a, const AxisValues& b) {
    for (std::size_t n = 0; n < axis_count; ++n) {
        if (!exactly_equal(a[n], b[n])) {
            return false;
        }
    }
    return true;
}

bool same_modes(const ModalView& a, const ModalView& b) {
    return a.motion == b.motion && a.plane == b.plane && a.unit == b.unit && a.incremental == b.incremental &&
           a.feed_mode == b.feed_mode && a.path_mode == b.path_mode && a.cutter == b.cutter &&
           a.retract_to_r == b.retract_to_r && a.coordinate_system == b.coordinate_system &&
           a.selected_tool == b.selected_tool && a.tool == b.tool && a.spindle == b.spindle &&
           a.mist == b.mist && a.flood == b.flood;
}

bool same_offsets(const ModalView& a, const ModalView& b) {
    return same(a.g5x_offset, b.g5x_offset) && same(a.g92_offset, b.g92_offset) &&
           same(a.tool_offset, b.tool_offset) &&
           exactly_equal(static_cast<double>(a.rotation_deg), static_cast<double>(b.rotation_deg));
}

bool same(float a, float b) {
    return exactly_equal(static_cast<double>(a), static_cast<double>(b));
}

ModalView view_of(const ModalState& s) {
    const double unit = s.unit == LengthUnit::inch ? mm_per_inch : 1.0;
    return {.motion = s.motion,
            .plane = s.plane,
            .unit = s.unit,
            .incremental = s.distance == DistanceMode::incremental,
            .feed_mode = s.feed_mode,
            .path_mode = s.path_mode,
            .cutter = s.cutter.side,
            .retract_to_r = s.cycle_return == CycleReturn::r_level,
            .coordinate_system = s.coordinate_system,
            .selected_tool = s.selected_tool,
            .tool = s.spindle_tool.number,
            .spindle = s.spindle,
            .mist = s.mist,
            .flood = s.flood,
            .feed = static_cast<float>(s.feed_rate),
            .spindle_speed = static_cast<float>(s.spindle_speed),
            .rotation_deg = static_cast<float>(s.rotation_deg),
            .g5x_offset = s.g5x_offset.lengths_scaled(unit),
            .g92_offset = s.g92_offset.lengths_scaled(unit),
            .tool_offset = s.tool_offset.lengths_scaled(unit)};
}

} // namespace

void Execution::add(std::int32_t line, const ModalState& state) {
    const Step step = count_++;
    const std::int32_t at = line > 0 ? line : std::max(line_, 1);
    if (step == 0 || at != line_ + 1) {
        jumps_.push_back({step, at});
    }
    line_ = at;
    const ModalView now = view_of(state);
    if (step == 0 || !same_modes(now, last_)) {
        mode_changes_.push_back({step, index_of(now)});
    }
    if (step == 0 || !same(now.feed, last_.feed)) {
        feeds_.push_back({step, now.feed});
    }
    if (step == 0 || !same(now.spindle_speed, last_.spindle_speed)) {
        speeds_.push_back({step, now.spindle_speed});
    }
    if (step == 0 || !same_offsets(now, last_)) {
        offsets_.push_back({step, now.g5x_offset, now.g92_offset, now.tool_offset, now.rotation_deg});
    }
    last_ = now;
}

/// Programs use few combinations of modes again and again; the newest are looked at first.
std::uint32_t Execution::index_of(const ModalView& modes) {
    constexpr std::size_t remembered = 32;
    const std::size_t oldest = modes_.size() > remembered ? modes_.size() - remembered : 0;
    for (std::size_t n = modes_.size(); n > oldest; --n) {
        if (same_modes(modes_[n - 1], modes)) {
            return static_cast<std::uint32_t>(n - 1);
        }
    }
    modes_.push_back(modes);
    return static_cast<std::uint32_t>(modes_.size() - 1);
}

std::int32_t Execution::line_of(Step step) const {
    expects(step < count_, "a step of the program");
    const Jump& jump = last_until(jumps_, step);
    return jump.line + static_cast<std::int32_t>(step - jump.step);
}

std::optional<Step> Execution::step_of(std::int32_t first, std::int32_t last) const {
    for (std::size_t n = 0; n < jumps_.size(); ++n) {
        const Jump& run = jumps_[n];
        const Step end = n + 1 < jumps_.size() ? jumps_[n + 1].step : count_;
        const std::int32_t last_of_run = run.line + static_cast<std::int32_t>(end - run.step) - 1;
        if (run.line <= last && last_of_run >= first) {
            return run.step + static_cast<Step>(std::max(first - run.line, 0));
        }
    }
    return std::nullopt;
}

Step Execution::step_at_or_after(std::int32_t line) const {
    expects(count_ > 0, "a program that was executed");
    const auto found = step_of(line, line);
    if (found) {
        return *found;
    }
    Step best = count_ - 1;
    std::int32_t nearest = std::numeric_limits<std::int32_t>::max();
    for (const Jump& jump : jumps_) {
        if (jump.line > line && jump.line < nearest) {
            nearest = jump.line;
            best = jump.step;
        }
    }
    return best;
}

ModalView Execution::state_after(Step step) const {
    expects(step < count_, "a step of the program");
    ModalView found = modes_[last_until(mode_changes_, step).index];
    found.feed = last_until(feeds_, step).value;
    found.spindle_speed = last_until(speeds_, step).value;
    const Offsets& offsets = last_until(offsets_, step);
    found.g5x_offset = offsets.g5x;
    found.g92_offset = offsets.g92;
    found.tool_offset = offsets.tool;
    found.rotation_deg = offsets.rotation_deg;
    return found;
}

void Execution::shrink() {
    jumps_.shrink_to_fit();
    modes_.shrink_to_fit();
    mode_changes_.shrink_to_fit();
    feeds_.shrink_to_fit();
    speeds_.shrink_to_fit();
    offsets_.shrink_to_fit();
}

std::size_t Execution::bytes() const {
    return jumps_.capacity() * sizeof(Jump) + modes_.capacity() * sizeof(ModalView) +
           mode_changes_.capacity() * sizeof(Modes) +
           (feeds_.capacity() + speeds_.capacity()) * sizeof(Change) + offsets_.capacity() * sizeof(Offsets);
}

} // namespace millwright::gcode
