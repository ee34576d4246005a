#include "core/gcode_programs/internal/start_moves.h"

#include "core/gcode_programs/programmed_feed.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace millwright::gcode::internal {

StartMoves::StartMoves(const kinematics::MachineModel& machine) : machine_(machine) {
    if (!machine.linear_axes().empty()) {
        retract_ = program::retract_axis(machine);
        const char letter = machine.axis(retract_->axis).letter;
        letter_ = static_cast<std::size_t>(std::ranges::find(axis_letters, letter) - axis_letters.begin());
    }
}

void StartMoves::use_tool(const AxisValues& offset, double unit) {
    tool_length_ = offset[letter_] * unit;
}

void StartMoves::set(int axis, int line) {
    first_set_.emplace_back(axis, line);
}

void StartMoves::move(const Move& move, const AxisValues& from, const AxisValues& to, const MoveAxes& axes) {
    const Height height = height_of(move, from, to);
    note_cut(move, height, axes);
    note_early(move, height, axes);
    last_height_ = height.tip;
}

void StartMoves::curve() {
    highest_cut_ = std::max(highest_cut_.value_or(last_height_), last_height_);
}

StartMoves::Height
StartMoves::height_of(const Move& move, const AxisValues& from, const AxisValues& to) const {
    if (!retract_) {
        return {};
    }
    return {retract_->sense * (to[letter_] - tool_length_),
            retract_->sense * move.target[letter_],
            retract_->sense * (to[letter_] - from[letter_])};
}

/// At rapid with the retract axis alone, to above the part's zero, or, where that is not known on the
/// machine, as far off the part as the axis travels.
bool StartMoves::lifts(const Move& move, const Height& height, const MoveAxes& axes) const {
    if (!retract_ || move.kind != MoveKind::traverse) {
        return false;
    }
    program::AxisSet alone;
    alone.insert(retract_->axis);
    if (!(axes.named == alone)) {
        return false;
    }
    if (axes.height_is_known) {
        return height.above_part > same_place;
    }
    const kinematics::MachineAxis& axis = machine_.axis(retract_->axis);
    const double limit = retract_->sense > 0.0 ? axis.max : -axis.min;
    return height.tip + retract_->sense * tool_length_ >= limit - same_place;
}

/// A feed straight off the part cuts nothing.
void StartMoves::note_cut(const Move& move, const Height& height, const MoveAxes& axes) {
    const bool leaves =
        retract_ && axes.moving == std::vector<int>{retract_->axis} && height.travelled > same_place;
    if (move.kind != MoveKind::traverse && !leaves) {
        highest_cut_ = std::max(highest_cut_.value_or(height.tip), height.tip);
    }
}

void StartMoves::note_early(const Move& move, const Height& height, const MoveAxes& axes) {
    if (first_move_ || axes.known == program::AxisSet::all(machine_.axis_count())) {
        return;
    }
    EarlyMove early{move.source, axes.known, {}, height.tip};
    for (int n = 0; n < machine_.axis_count(); ++n) {
        if (axes.named.contains(n) || std::ranges::find(axes.moving, n) != axes.moving.end()) {
            early.moving.push_back(n);
        }
    }
    if (!lifts(move, height, axes)) {
        first_move_ = std::move(early);
    } else if (!lowest_lift_ || height.tip < lowest_lift_->height) {
        lowest_lift_ = std::move(early);
    }
}

std::string StartMoves::letters_of(const std::vector<int>& axes) const {
    std::string text;
    for (std::size_t n = 0; n < axes.size(); ++n) {
        const bool last = n + 1 == axes.size();
        text += n == 0 ? "" : last ? " and " : ", ";
        text += machine_.axis(axes[n]).letter;
    }
    return text;
}

/// "sets Y and Z for the first time in line 3, A in line 5, never sets C".
std::string StartMoves::when_set(const std::vector<int>& unknown) const {
    std::vector<std::pair<int, std::vector<int>>> lines; // in the order of the program
    std::vector<int> never = unknown;
    for (const auto& [axis, line] : first_set_) {
        if (std::ranges::find(unknown, axis) == unknown.end()) {
            continue;
        }
        if (lines.empty() || lines.back().first != line) {
            lines.emplace_back(line, std::vector<int>());
        }
        lines.back().second.push_back(axis);
        std::erase(never, axis);
    }
    std::vector<std::string> parts;
    for (const auto& [line, axes] : lines) {
        parts.push_back(parts.empty()
                            ? fmt::format("sets {} for the first time in line {}", letters_of(axes), line)
                            : fmt::format("{} in line {}", letters_of(axes), line));
    }
    if (!never.empty()) {
        parts.push_back("never sets " + letters_of(never));
    }
    return fmt::format("{}", fmt::join(parts, ", "));
}

std::optional<Diagnostic> StartMoves::notice(const std::filesystem::path& file) const {
    const bool lift_is_low =
        lowest_lift_ && highest_cut_ && *highest_cut_ > lowest_lift_->height - same_place;
    const std::optional<EarlyMove>& early = lift_is_low ? lowest_lift_ : first_move_;
    if (!early) {
        return std::nullopt;
    }
    std::vector<int> unknown;
    for (int n = 0; n < machine_.axis_count(); ++n) {
        if (!early->known.contains(n)) {
            unknown.push_back(n);
        }
    }
    const bool several = unknown.size() > 1;
    return Diagnostic{{file, early->source.line, 0, -1},
                      fmt::format("the start {} of {} {} unknown: {} {} here, but the program {}",
                                  several ? "positions" : "position",
                                  letters_of(unknown),
                                  several ? "are" : "is",
                                  letters_of(early->moving),
                                  early->moving.size() > 1 ? "move" : "moves",
                                  when_set(unknown)),
                      "move the tool clear of obstacles before the start"};
}

} // namespace millwright::gcode::internal
