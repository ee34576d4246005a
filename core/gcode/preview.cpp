#include "core/gcode/preview.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/base/units.h"
#include "core/gcode/canon_frame.h"
#include "core/kinematics/forward.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::gcode {

namespace {

constexpr double usual_rapid = 100.0;      // mm/s: where no machine is known
constexpr double turn_per_piece_deg = 3.0; // of rotary axes, whose ways are bent on the part

} // namespace

class PreviewBuilder::Parts {
public:
    Parts(PreviewSettings settings, ChunkListener listener)
        : settings_(std::move(settings)), listener_(std::move(listener)) {
        expects(settings_.chord_tolerance > 0.0, "a chord tolerance is positive");
        if (settings_.machine) {
            prepare(*settings_.machine);
        }
        chunker_.add(PreviewPoint(tip(at_), 0, PathKind::start), 0.0);
        last_ = tip(at_);
    }

    void begin_step(Step step) { step_ = step; }

    void finish() {
        if (auto rest = chunker_.take_rest()) {
            listener_(std::move(rest));
        }
    }

    void move(const Move& move) {
        const bool is_rapid = move.kind == MoveKind::traverse;
        const PathKind kind = is_rapid                       ? PathKind::rapid
                              : move.kind == MoveKind::probe ? PathKind::probe
                                                             : PathKind::feed;
        if (move.kind == MoveKind::arc) {
            arc_chords(frame_.from_machine(at_), move, tolerance(), [&](const AxisValues& end) {
                go(PathKind::feed, frame_.to_machine(end));
            });
            return;
        }
        const AxisValues start = at_;
        go(kind, frame_.to_machine(move.target));
        if (move.kind == MoveKind::rigid_tap) {
            go(PathKind::feed, start);
        }
    }

    void curve(const Curve& curve) {
        curve_chords(frame_.from_machine(at_), curve, tolerance(), [&](const AxisValues& end) {
            go(PathKind::feed, frame_.to_machine(end));
        });
    }

    void command(const Command& command) {
        frame_.command(command);
        if (command.kind == CommandKind::use_tool_length_offset) {
            tool_ = command.axes.lengths_scaled(frame_.unit());
        } else if (command.kind == CommandKind::set_feed_rate) {
            feed_ = command.value;
        } else if (command.kind == CommandKind::dwell) {
            seconds_ += command.value;
            waiting_ += command.value;
        }
    }

    [[nodiscard]] double seconds() const { return seconds_; }
    [[nodiscard]] double length() const { return length_; }

private:
    PreviewSettings settings_;
    ChunkListener listener_;
    PathChunker chunker_;
    CanonFrame frame_;
    AxisValues at_;   ///< of the axes, mm and deg
    AxisValues tool_; ///< length offsets: the tip is that far from where the axes are
    Vec3 last_ = Vec3::Zero();
    Step step_ = 0;
    double feed_ = 0.0;
    double rapid_ = usual_rapid;
    double seconds_ = 0.0;
    double waiting_ = 0.0; ///< dwells since the last point, s
    double length_ = 0.0;
    std::vector<std::size_t> axis_of_; ///< of the machine's axes: index into AxisValues
    bool turns_ = false;               ///< the machine has rotary axes
    kinematics::AxisPositions positions_;

    void prepare(const kinematics::MachineModel& machine) {
        positions_ = kinematics::AxisPositions::Zero(machine.axis_count());
        for (const kinematics::MachineAxis& axis : machine.axes()) {
            const auto letter = std::ranges::find(axis_letters, axis.letter);
            axis_of_.push_back(static_cast<std::size_t>(letter - axis_letters.begin()));
            turns_ = turns_ || axis.kind == kinematics::AxisKind::rotary;
        }
        for (const int n : machine.linear_axes()) {
            rapid_ = std::min(n == machine.linear_axes()[0] ? machine.axis(n).max_velocity : rapid_,
                              machine.axis(n).max_velocity);
        }
    }

    [[nodiscard]] double tolerance() const { return settings_.chord_tolerance / frame_.unit(); }

    [[nodiscard]] Vec3 tip(const AxisValues& axes) {
        if (!turns_) {
            return {axes[Axis::x] - tool_[Axis::x],
                    axes[Axis::y] - tool_[Axis::y],
                    axes[Axis::z] - tool_[Axis::z]};
        }
        for (std::size_t n = 0; n < axis_of_.size(); ++n) {
            const double value = axes[axis_of_[n]];
            positions_[static_cast<Eigen::Index>(n)] = is_rotary(axis_of_[n]) ? from_degrees(value) : value;
        }
        return kinematics::forward(*settings_.machine, positions_).tip;
    }

    [[nodiscard]] static double turn_between(const AxisValues& a, const AxisValues& b) {
        return std::max({std::abs(b[Axis::a] - a[Axis::a]),
                         std::abs(b[Axis::b] - a[Axis::b]),
                         std::abs(b[Axis::c] - a[Axis::c])});
    }

    void go(PathKind kind, const AxisValues& end) {
        if (!turns_) {
            return add(kind, end);
        }
        const AxisValues start = at_;
        const int pieces =
            std::clamp(static_cast<int>(std::ceil(turn_between(start, end) / turn_per_piece_deg)), 1, 360);
        for (int n = 1; n <= pieces; ++n) {
            const double t = static_cast<double>(n) / pieces;
            AxisValues between;
            for (std::size_t k = 0; k < axis_count; ++k) {
                between[k] = mix(start[k], end[k], t);
            }
            add(kind, between);
        }
    }

    void add(PathKind kind, const AxisValues& end) {
        at_ = end;
        const Vec3 here = tip(end);
        const double way = (here - last_).norm();
        last_ = here;
        length_ += way;
        const double speed = kind == PathKind::rapid ? rapid_ : from_mm_per_min(feed_ * frame_.unit());
        const double seconds = speed > 0.0 ? way / speed : 0.0;
        seconds_ += seconds;
        chunker_.add(PreviewPoint(here, step_, kind), seconds + std::exchange(waiting_, 0.0));
        if (auto full = chunker_.take_full()) {
            listener_(std::move(full));
        }
    }
};

PreviewBuilder::PreviewBuilder(PreviewSettings settings, ChunkListener listener)
    : parts_(std::make_unique<Parts>(std::move(settings), std::move(listener))) {}

PreviewBuilder::~PreviewBuilder() = default;

void PreviewBuilder::begin_step(Step step) {
    parts_->begin_step(step);
}

void PreviewBuilder::finish() {
    parts_->finish();
}

void PreviewBuilder::move(const Move& move, const SourceLine&) {
    parts_->move(move);
}

void PreviewBuilder::curve(const Curve& curve, const SourceLine&) {
    parts_->curve(curve);
}

void PreviewBuilder::command(const Command& command, const SourceLine&) {
    parts_->command(command);
}

double PreviewBuilder::seconds() const {
    return parts_->seconds();
}

double PreviewBuilder::length() const {
    return parts_->length();
}

} // namespace millwright::gcode
