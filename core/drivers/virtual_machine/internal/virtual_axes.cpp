#include "core/drivers/virtual_machine/internal/virtual_axes.h"

#include "core/base/error.h"
#include "core/motion/hold.h"
#include "core/motion/planner.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace millwright::drivers::internal {

using kinematics::AxisPositions;
using motion::Trajectory;

namespace {

constexpr double percent = 0.01;
constexpr int blocks_ahead = 2000; // that a change while running plans anew: some ms
constexpr double never = std::numeric_limits<double>::infinity();

} // namespace

VirtualAxes::VirtualAxes(AxisPositions position, std::shared_ptr<const kinematics::MachineModel> model)
    : model_(std::move(model)), rest_position_(std::move(position)) {
    expects(rest_position_.size() > 0 && rest_position_.allFinite(), "the position of a machine is finite");
    if (model_) {
        expects(rest_position_.size() == model_->axis_count(),
                "the position of a machine has a value for each of its axes");
        control_.emplace(model_);
    }
}

DriverStatus VirtualAxes::status() const {
    DriverStatus status;
    status.state = state_;
    status.message = message_;
    if (state_ == DriverState::disconnected) {
        return status;
    }
    status.activity = !moving() && state_ != DriverState::holding ? Activity::none : activity_;
    status.answer = answer_;
    status.position = rest_position_;
    status.velocity = AxisPositions::Zero(rest_position_.size());
    status.work_offset = AxisPositions::Zero(rest_position_.size());
    if (control_) {
        status.work_offset = control_->work_offset();
        status.work_system = control_->work_system();
        status.modes = control_->modes();
        status.tool = control_->tool();
    }
    using gcode::SpindleTurning;
    status.spindle = spindle_rpm_ > 0.0   ? SpindleTurning::clockwise
                     : spindle_rpm_ < 0.0 ? SpindleTurning::counterclockwise
                                          : SpindleTurning::stopped;
    status.spindle_rpm = std::abs(spindle_rpm_) * percent * overrides_.spindle;
    status.overrides = overrides_;
    status.coolant.flood = coolant_;
    if (now_ != nullptr) {
        const motion::Sample sample = now_->at(time_);
        if (moving()) {
            status.position = sample.position;
            status.velocity = sample.velocity;
        }
        show_program(status, sample);
    }
    return status;
}

void VirtualAxes::show_program(DriverStatus& status, const motion::Sample& sample) const {
    if (activity_ != Activity::program) {
        return;
    }
    if (state_ == DriverState::idle) {
        status.block = sample.block;
        status.fraction = sample.fraction;
        status.executed_blocks = now_->block_count();
        status.planned_time = work_.trajectory->duration();
        return;
    }
    const bool begins = pace_ == Pace::at_pause || pace_ == Pace::between_blocks;
    status.block = pace_ == Pace::at_pause         ? pause_
                   : pace_ == Pace::between_blocks ? now_->last_block() + 1
                                                   : sample.block;
    status.fraction = begins ? 0.0 : sample.fraction;
    status.executed_blocks = status.block;
    status.planned_time = work_.trajectory->time_at(status.block, status.fraction);
}

std::vector<StoredOffset> VirtualAxes::stored_offsets() const {
    return control_ && state_ != DriverState::disconnected ? control_->stored_offsets()
                                                           : std::vector<StoredOffset>{};
}

bool VirtualAxes::moving() const {
    return pace_ == Pace::moving;
}

void VirtualAxes::advance(double seconds) {
    expects(seconds >= 0.0, "time does not run backwards");
    while (moving()) { // more than once only where a jog follows another
        const double left = std::min({now_->duration(), look_at_, pause_at_}) - time_;
        if (seconds < left) {
            time_ += seconds;
            take_accessories(now_->block_at(time_));
            return;
        }
        seconds -= left;
        time_ += left;
        if (pause_at_ <= std::min(now_->duration(), look_at_)) {
            wait_for_person();
        } else if (look_at_ < now_->duration()) {
            go_on();
        } else {
            time_ = now_->duration();
            come_to_rest();
        }
    }
}

void VirtualAxes::come_to_rest() {
    pace_ = Pace::at_rest;
    rest_position_ = now_->at(time_).position;
    if (state_ == DriverState::running) {
        take_accessories(now_->last_block() + 1);
        const bool more = activity_ == Activity::program && now_->last_block() + 1 < now_->block_count();
        pace_ = more ? Pace::between_blocks : Pace::at_rest;
        state_ = more ? DriverState::holding : DriverState::idle;
    } else if (state_ == DriverState::stopping) {
        state_ = DriverState::stopped;
    }
    if (answer_.state == CommandAnswer::State::pending && state_ != DriverState::holding) {
        const bool done = state_ == DriverState::idle;
        answer_.state = done ? CommandAnswer::State::done : CommandAnswer::State::refused;
        answer_.text = done ? "" : "stopped";
    }
    leg_.reset();
    if (state_ == DriverState::idle && activity_ == Activity::jog && !legs_.empty()) {
        const Leg next = legs_.front();
        legs_.pop_front();
        (void)begin_leg(next);
    }
}

/// Spindle and coolant of the blocks that have been executed.
void VirtualAxes::take_accessories(int executed_blocks) {
    if (work_.program == nullptr) {
        return;
    }
    using program::BlockKind;
    for (; switched_blocks_ < executed_blocks; ++switched_blocks_) {
        const program::Block& block = work_.program->blocks[static_cast<std::size_t>(switched_blocks_)];
        const bool ends = block.kind == BlockKind::end && activity_ == Activity::program;
        if (block.kind == BlockKind::spindle_on) {
            spindle_rpm_ = block.spindle_rpm;
        } else if (block.kind == BlockKind::coolant_on) {
            coolant_ = true;
        }
        spindle_rpm_ = block.kind == BlockKind::spindle_off || ends ? 0.0 : spindle_rpm_;
        coolant_ = block.kind != BlockKind::coolant_off && !ends && coolant_;
    }
}

void VirtualAxes::follow(Trajectory next, DriverState state) {
    now_ = std::make_shared<const Trajectory>(std::move(next));
    time_ = 0.0;
    look_at_ = never;
    pace_ = Pace::moving;
    state_ = state;
    pause_at_ = time_of_pause();
    advance(0.0);
}

void VirtualAxes::connect() {
    if (state_ == DriverState::disconnected) {
        state_ = DriverState::idle;
        now_ = nullptr;
        message_.clear();
        answer_ = {};
    }
}

void VirtualAxes::require_model(std::string_view what) const {
    if (!model_) {
        throw Error(fmt::format("this virtual machine has no model and cannot accept a {}", what));
    }
}

void VirtualAxes::require_rest(std::string_view what) const {
    if (state_ != DriverState::idle && state_ != DriverState::stopped) {
        throw Error(fmt::format("the virtual machine is {} and cannot accept a {}", in_words(state_), what),
                    {},
                    state_ == DriverState::alarm ? message_ + "; inspect the machine, then reset it" : "");
    }
}

void VirtualAxes::stands_at(const AxisPositions& position) {
    require_rest("position");
    expects(position.size() == rest_position_.size() && position.allFinite(),
            "each axis has a finite position");
    rest_position_ = position;
}

void VirtualAxes::start(Work work) {
    expects(work.program != nullptr && work.trajectory != nullptr,
            "a machine is given a program and its motion");
    require_rest("program");
    const AxisPositions begin = work.trajectory->at(0.0).position;
    constexpr double same_place = 1e-6; // mm or rad
    if (begin.size() != rest_position_.size() ||
        !((begin - rest_position_).cwiseAbs().maxCoeff() <= same_place)) {
        throw Error(
            "the virtual machine is not where the motion starts", {}, "plan the motion from its position");
    }
    answer_.forget();
    execute(std::move(work), Activity::program);
}

void VirtualAxes::execute(Work work, Activity activity) {
    work_ = std::move(work);
    now_ = work_.trajectory;
    time_ = 0.0;
    look_at_ = never;
    pace_ = Pace::moving;
    state_ = DriverState::running;
    activity_ = activity;
    message_.clear();
    overrides_ = {};
    switched_blocks_ = 0;
    look_for_pause(0);
    pause_at_ = time_of_pause();
    if (single_block_ && activity == Activity::program) {
        go_on();
    }
    advance(0.0);
}

void VirtualAxes::execute(program::Program program, Activity activity) {
    auto trajectory =
        std::make_shared<const Trajectory>(motion::plan(program, *model_, {}, Progress(), rest_position_));
    execute({std::make_shared<const program::Program>(std::move(program)), std::move(trajectory), nullptr},
            activity);
}

void VirtualAxes::set_overrides(const Overrides& wanted) {
    if (state_ == DriverState::disconnected) {
        throw Error("the virtual machine is disconnected and cannot accept overrides");
    }
    constexpr int least = 1;
    constexpr int most = 200;
    constexpr int most_rapid = 100;
    overrides_ = {std::clamp(wanted.feed, least, most),
                  std::clamp(wanted.rapid, least, most_rapid),
                  std::clamp(wanted.spindle, least, most)};
    if (state_ == DriverState::running &&
        (activity_ == Activity::program || activity_ == Activity::command)) {
        go_on();
        advance(0.0);
    }
}

void VirtualAxes::set_single_block(bool on) {
    if (on == single_block_) {
        return;
    }
    single_block_ = on;
    if (state_ == DriverState::running && activity_ == Activity::program) {
        go_on();
        advance(0.0);
    }
}

/// As far as is looked ahead; advance() does it again before that matters. Block by block: to the end of the
/// next, or of the first in which the axes can come to rest.
void VirtualAxes::go_on() {
    const bool one = single_block_ && activity_ == Activity::program;
    Trajectory next = motion::go_on_for(one ? 1 : blocks_ahead, *now_, time_, rates());
    const bool whole = one || next.last_block() + 1 == next.block_count();
    const double look = whole ? never : next.start_of((next.first_block() + next.last_block()) / 2);
    now_ = std::make_shared<const Trajectory>(std::move(next));
    time_ = 0.0;
    look_at_ = look;
    pace_ = Pace::moving;
    state_ = DriverState::running;
    pause_at_ = time_of_pause();
}

motion::Override VirtualAxes::rates() const {
    return {percent * overrides_.feed, percent * overrides_.rapid};
}

void VirtualAxes::hold() {
    if (activity_ == Activity::jog) {
        stop_jog();
    } else if (state_ == DriverState::running) {
        follow(motion::brake(*now_, time_), DriverState::holding);
    }
}

void VirtualAxes::resume() {
    if (state_ == DriverState::holding) {
        if (pace_ == Pace::at_pause) {
            message_.clear();
            look_for_pause(pause_ + 1);
        }
        go_on();
        advance(0.0);
    }
}

void VirtualAxes::stop() {
    legs_.clear();
    if (state_ == DriverState::running) {
        follow(motion::brake(*now_, time_), DriverState::stopping);
    } else if (state_ == DriverState::holding) {
        state_ = !moving() ? DriverState::stopped : DriverState::stopping;
        message_.clear();
    }
}

void VirtualAxes::emergency_stop(std::string why) {
    if (state_ == DriverState::disconnected || state_ == DriverState::alarm) {
        return;
    }
    if (moving()) {
        rest_position_ = now_->at(time_).position;
        pace_ = Pace::at_rest;
    }
    state_ = DriverState::alarm;
    message_ = std::move(why);
    legs_.clear();
    spindle_rpm_ = 0.0;
    coolant_ = false;
    answer_.break_off(message_);
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

} // namespace millwright::drivers::internal
