#include "core/machine/drivers/virtual_machine/internal/virtual_axes.h"

#include "core/base/error.h"
#include "core/motion/hold.h"

#include <fmt/format.h>

#include <limits>
#include <utility>

namespace millwright::machine::internal {

using kinematics::AxisPositions;
using motion::Trajectory;

VirtualAxes::VirtualAxes(AxisPositions position) : rest_position_(std::move(position)) {
    expects(rest_position_.size() > 0 && rest_position_.allFinite(), "a machine stands at a finite position");
}

DriverStatus VirtualAxes::status() const {
    DriverStatus status;
    status.state = state_;
    status.message = message_;
    if (state_ == DriverState::disconnected) {
        return status;
    }
    status.position = rest_position_;
    status.velocity = AxisPositions::Zero(rest_position_.size());
    if (now_ == nullptr) {
        return status;
    }
    const motion::Sample sample = now_->at(time_);
    const bool finished = state_ == DriverState::idle;
    if (!at_rest_) {
        status.position = sample.position;
        status.velocity = sample.velocity;
    }
    status.block = sample.block;
    status.fraction = sample.fraction;
    status.executed_blocks = finished ? now_->block_count() : sample.block;
    status.planned_time =
        finished ? work_.trajectory->duration() : work_.trajectory->time_at(sample.block, sample.fraction);
    return status;
}

bool VirtualAxes::moving() const {
    return !at_rest_;
}

void VirtualAxes::advance(double seconds) {
    expects(seconds >= 0.0, "time does not run backwards");
    if (at_rest_) {
        return;
    }
    time_ += seconds;
    if (time_ >= now_->duration()) {
        time_ = now_->duration();
        come_to_rest();
    }
}

void VirtualAxes::come_to_rest() {
    at_rest_ = true;
    rest_position_ = now_->at(time_).position;
    if (state_ == DriverState::running) {
        state_ = DriverState::idle;
    } else if (state_ == DriverState::stopping) {
        state_ = DriverState::stopped;
    }
}

void VirtualAxes::follow(Trajectory next, DriverState state) {
    now_ = std::make_shared<const Trajectory>(std::move(next));
    time_ = 0.0;
    at_rest_ = false;
    state_ = state;
    advance(0.0);
}

void VirtualAxes::connect() {
    if (state_ == DriverState::disconnected) {
        state_ = DriverState::idle;
        now_ = nullptr;
        message_.clear();
    }
}

void VirtualAxes::start(Work work) {
    expects(work.program != nullptr && work.trajectory != nullptr,
            "a machine is given a program and its motion");
    if (state_ != DriverState::idle && state_ != DriverState::stopped) {
        throw Error(fmt::format("the virtual machine is {} and takes no program", to_text(state_)),
                    {},
                    state_ == DriverState::alarm ? message_ + "; look at the machine, then reset it" : "");
    }
    const AxisPositions begin = work.trajectory->at(0.0).position;
    constexpr double same_place = 1e-6; // mm or rad
    if (begin.size() != rest_position_.size() ||
        !((begin - rest_position_).cwiseAbs().maxCoeff() <= same_place)) {
        throw Error(
            "the virtual machine does not stand where the motion begins", {}, "plan it from the position");
    }
    work_ = std::move(work);
    now_ = work_.trajectory;
    time_ = 0.0;
    at_rest_ = false;
    state_ = DriverState::running;
    advance(0.0);
}

void VirtualAxes::hold() {
    if (state_ == DriverState::running) {
        follow(motion::brake(*work_.trajectory, now_->state_at(time_)), DriverState::holding);
    }
}

void VirtualAxes::resume() {
    if (state_ == DriverState::holding) {
        follow(motion::rejoin(*work_.trajectory, now_->state_at(time_)), DriverState::running);
    }
}

void VirtualAxes::stop() {
    if (state_ == DriverState::running) {
        follow(motion::brake(*work_.trajectory, now_->state_at(time_)), DriverState::stopping);
    } else if (state_ == DriverState::holding) {
        state_ = at_rest_ ? DriverState::stopped : DriverState::stopping;
    }
}

void VirtualAxes::emergency_stop(std::string why) {
    if (state_ == DriverState::disconnected || state_ == DriverState::alarm) {
        return;
    }
    if (!at_rest_) {
        rest_position_ = now_->at(time_).position;
        at_rest_ = true;
    }
    state_ = DriverState::alarm;
    message_ = std::move(why);
}

void VirtualAxes::reset() {
    if (state_ == DriverState::alarm) {
        state_ = DriverState::idle;
        now_ = nullptr;
        message_.clear();
    }
}

void VirtualAxes::close() {
    stop();
    advance(std::numeric_limits<double>::max());
    state_ = DriverState::disconnected;
}

} // namespace millwright::machine::internal
