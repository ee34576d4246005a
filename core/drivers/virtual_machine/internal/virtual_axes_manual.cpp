// The virtual machine by hand: jogs, homing, single lines.
#include "core/base/error.h"
#include "core/drivers/virtual_machine/internal/virtual_axes.h"
#include "core/motion/hold.h"
#include "core/motion/planner.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::drivers::internal {

using kinematics::AxisPositions;
using motion::Trajectory;

void VirtualAxes::jog(const Jog& jog) {
    require_model("jog");
    const bool usable = jog.way.size() == rest_position_.size() && jog.way.allFinite() &&
                        jog.way.norm() > 0.0 && std::isfinite(jog.speed) && jog.speed > 0.0;
    expects(usable, "a jog moves axes of the machine at a speed");
    if (jogging() && state_ == DriverState::running && !jog_ends_) {
        if (jog.dead_man > 0.0 && !extend_jog(jog)) {
            stop_jog();
        }
        if (jog_ends_ || !(jog.dead_man > 0.0)) {
            legs_.push_back({jog.way, jog.speed});
        }
        return;
    }
    if (jogging() && jog_ends_ && jog.dead_man > 0.0) {
        legs_ = {{jog.way, jog.speed}}; // as soon as it stands
        return;
    }
    require_rest("jog");
    legs_.clear();
    if (!begin_leg({jog.way, jog.speed})) {
        throw Error("the machine is at the limit of its travel and cannot move further in this direction");
    }
}

/// As far as the limits of the axes allow; false if that is nowhere.
bool VirtualAxes::begin_leg(const Leg& leg) {
    const double reach = reach_within_limits(*model_, rest_position_, leg.way);
    constexpr double nothing = 1e-9; // of the way
    if (reach <= nothing) {
        return false;
    }
    jog_ends_ = false;
    leg_ = Leg{leg.way * reach, leg.speed};
    const AxisPositions target = rest_position_ + leg_->way;
    execute(straight_program(*model_, rest_position_, target, leg.speed), Activity::jog);
    return true;
}

/// Goes on in the same direction, `jog.way` from here; false if it is another direction or speed.
bool VirtualAxes::extend_jog(const Jog& jog) {
    constexpr double same = 1.0 - 1e-12;
    const double cosine = leg_->way.dot(jog.way) / (leg_->way.norm() * jog.way.norm());
    const bool same_speed = std::abs(jog.speed - leg_->speed) <= 1e-9 * jog.speed;
    if (!(cosine >= same) || !same_speed) {
        return false;
    }
    const AxisPositions start = work_.program->start;
    const AxisPositions here = now_->at(time_).position;
    AxisPositions way = here + jog.way - start;
    way *= reach_within_limits(*model_, start, way);
    if (way.norm() <= leg_->way.norm()) {
        return true; // it goes as far already, or as far as it can
    }
    leg_->way = way;
    program::Program longer = straight_program(*model_, start, start + way, jog.speed);
    auto planned = std::make_shared<const Trajectory>(motion::plan(longer, *model_, {}, Progress(), start));
    Trajectory next = motion::go_on_along(planned->shared_path(), *now_, time_, {});
    work_ = {std::make_shared<const program::Program>(std::move(longer)), std::move(planned), nullptr};
    follow(std::move(next), DriverState::running);
    return true;
}

void VirtualAxes::stop_jog() {
    legs_.clear();
    if (!jogging() || jog_ends_) {
        return;
    }
    jog_ends_ = true;
    follow(motion::brake(*now_, time_), DriverState::running);
}

void VirtualAxes::home() {
    require_model("homing request");
    if (state_ != DriverState::alarm) {
        require_rest("homing request");
    }
    AxisPositions zero = AxisPositions::Zero(model_->axis_count());
    for (int n = 0; n < model_->axis_count(); ++n) {
        zero[n] = std::clamp(0.0, model_->axis(n).min, model_->axis(n).max);
    }
    execute(straight_program(*model_, rest_position_, zero, 0.0), Activity::homing);
}

int VirtualAxes::command(const std::string& lines) {
    require_model("command");
    require_rest("command");
    answer_.begin();
    try {
        program::Program program = control_->read(lines, rest_position_);
        if (program.blocks.empty()) {
            program = straight_program(*model_, rest_position_, rest_position_, 0.0);
        }
        execute(std::move(program), Activity::command);
    } catch (const Error& error) {
        answer_.state = CommandAnswer::State::refused;
        answer_.text = error.what();
    }
    return answer_.number;
}

} // namespace millwright::drivers::internal
