#include "core/drivers/records/internal/record_session.h"

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/drivers/pause.h"
#include "core/links/link.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace millwright::drivers::records {

using kinematics::AxisPositions;
using kinematics::MachineAxis;
using kinematics::MachineModel;
using program::Block;
using program::BlockKind;

namespace {

/// The most that `limit` of the axes allows along `way`.
double along(const MachineModel& model, const AxisPositions& way, double MachineAxis::*limit) {
    double most = std::numeric_limits<double>::infinity();
    for (int n = 0; n < model.axis_count(); ++n) {
        if (std::abs(way[n]) > 0.0) {
            most = std::min(most, model.axis(n).*limit * way.norm() / std::abs(way[n]));
        }
    }
    return most;
}

/// From rest to rest.
double time_of(double length, double speed, double acceleration) {
    const double to_speed = speed * speed / acceleration; // mm: to get up to it, and down again
    return length < to_speed ? 2.0 * std::sqrt(length / acceleration) : length / speed + speed / acceleration;
}

/// Of moves that the table plans itself, so that the period does not count.
PointFormat checked_records(const RecordsOptions& options, const MachineModel& model) {
    std::vector<char> rotary;
    for (const MachineAxis& axis : model.axes()) {
        if (axis.kind != kinematics::AxisKind::linear) {
            rotary.push_back(axis.letter);
        }
    }
    if (!rotary.empty()) {
        throw Error(fmt::format("the table accepts straight moves only, but '{}' has the rotary {} {}",
                                model.name(),
                                rotary.size() == 1 ? "axis" : "axes",
                                fmt::join(rotary, " and ")));
    }
    return {.record = options.format, .decimals = options.decimals};
}

} // namespace

RecordSession::RecordSession(std::shared_ptr<const MachineModel> model,
                             AxisPositions position,
                             const RecordsOptions& options)
    : model_(std::move(model)), format_(options.format), decimals_(options.decimals),
      sender_(checked_records(options, *model_), *model_) {
    expects(position.size() == model_->axis_count(), "the table has a position for each axis");
    status_.position = std::move(position);
    status_.position_known = options.known;
    status_.velocity = status_.work_offset = AxisPositions::Zero(model_->axis_count());
}

void RecordSession::opened(double /*now*/) {
    sender_.forget_bytes();
    pace_ = {};
    listens_until_ = 0.0;
    sender_.begin(status_.position);
    status_.link_lost = false;
    if (status_.state == DriverState::disconnected) {
        status_.state = left_until_ ? DriverState::stopping : DriverState::idle;
    }
}

void RecordSession::lost(const std::string& why) {
    status_.link_lost = true;
    alarm(links::loss_sentence(why));
}

void RecordSession::closed() {
    status_.state = DriverState::disconnected;
    status_.activity = Activity::none;
    status_.message.clear();
    under_way_.reset();
    program_.reset();
    output_.clear();
}

double RecordSession::patience(double now) const {
    return listens(now) ? listens_until_ - now : ControllerSession::patience(now);
}

void RecordSession::rest(DriverState state, std::string why) {
    status_.state = state;
    status_.message = std::move(why);
    rests_ = state == DriverState::holding;
    if (state != DriverState::holding) {
        status_.activity = Activity::none;
        program_.reset();
    }
}

void RecordSession::alarm(std::string why) {
    if (under_way_ && under_way_->record) {
        status_.position_doubt =
            fmt::format("record {} had been sent, and it is not known how far it was executed", records_);
        left_until_ = under_way_->over + (awaits_answers() ? format_.patience : 0.0);
    }
    under_way_.reset();
    output_.clear();
    rest(DriverState::alarm, std::move(why));
}

void RecordSession::start(const Work& work, double now) {
    if (status_.state != DriverState::idle && status_.state != DriverState::stopped) {
        throw Error(fmt::format("the table is {} and cannot accept a program", in_words(status_.state)),
                    {},
                    status_.message);
    }
    if (!status_.position_doubt.empty()) {
        throw Error(doubt_sentence(status_.position_doubt) +
                        " The first record could move through the workpiece from there",
                    {},
                    "read X, Y and Z at the table and enter them");
    }
    if (!work.program) {
        throw Error("the records driver cannot run G-code that Millwright did not generate");
    }
    for (const Block& block : work.program->blocks) {
        expects(block.target.size() == model_->axis_count(), "the program is for this table");
    }
    sender_.expect_all_told(*work.program, *model_);
    program_ = work.program;
    listing_ = work.listing;
    trajectory_ = work.trajectory;
    send_window_.begin(work.ahead, program_->block_count());
    host_stall_.begin(now);
    status_.block = next_ = 0;
    status_.executed_blocks = status_.sent_blocks = 0;
    status_.fraction = 0.0;
    status_.planned_time = 0.0;
    status_.message.clear();
    status_.state = DriverState::running;
    status_.activity = Activity::program;
    tick(now);
}

void RecordSession::receive(std::string_view bytes, double now) {
    for (auto heard = sender_.hear(bytes); heard; heard = sender_.hear()) {
        if (left_until_) {
            left_until_.reset();
        } else if (awaits_answers() && status_.state != DriverState::alarm) {
            answered(heard->line, now);
        }
    }
}

void RecordSession::answered(const std::string& line, double now) {
    if (!under_way_ || !under_way_->record) {
        alarm(fmt::format("the machine sent '{}' before record {} was sent", line, records_ + 1));
        if (records_ > 0 && line == format_.answer) {
            status_.position_doubt = "the table answers more often than it receives records";
        }
    } else if (line != format_.answer) {
        alarm(fmt::format("the machine answered '{}' to record {}", line, records_));
        left_until_.reset();
    } else if (const double after = now - under_way_->sent; !pace_.fits(under_way_->way, after)) {
        alarm(fmt::format("the machine answered record {} after {:.2f} s, although its move takes {:.2f} s: "
                          "it answers more often than it receives records",
                          records_,
                          after,
                          under_way_->way));
    } else {
        constexpr double listening = 0.01; // as long as a few letters take at 9600 baud
        listens_until_ = now + listening;
        land(now);
    }
}

/// What was under way is over.
void RecordSession::land(double now) {
    status_.position = under_way_->target;
    status_.position_known = status_.position_known || (under_way_->record && !format_.relative);
    under_way_.reset();
    executed();
    claim_executed();
    tick(now);
}

void RecordSession::executed() {
    ++next_;
    status_.block = std::min(next_, program_->block_count() - 1);
    if (single_block_ && status_.state == DriverState::running) {
        status_.state = DriverState::holding;
    }
}

/// Blocks that are not sent to the table, as the spindle's, are executed with the next that is sent.
void RecordSession::claim_executed() {
    status_.executed_blocks = next_;
    if (trajectory_) {
        status_.planned_time =
            next_ < program_->block_count() ? trajectory_->start_of(next_) : trajectory_->duration();
    }
}

void RecordSession::look_at_clock(double now) {
    if (!under_way_ || now < under_way_->over) {
        return;
    }
    if (!under_way_->record || !awaits_answers()) {
        land(now);
    } else if (now > under_way_->over + format_.patience) {
        alarm(fmt::format(
            "no answer to record {} within {} s after the time of its move", records_, format_.patience));
    }
}

bool RecordSession::may_begin_block(double now) {
    if (status_.state != DriverState::running || under_way_ || listens(now) ||
        next_ >= program_->block_count()) {
        return false;
    }
    return send_window_.allows(next_);
}

void RecordSession::tick(double now) {
    const double pause = host_stall_.taken(now);
    if (under_way_ && under_way_->record && awaits_answers()) {
        under_way_->over += pause;
    }
    look_at_clock(now);
    if (left_until_ && now >= *left_until_) {
        left_until_.reset();
    }
    if (status_.state == DriverState::stopping && !program_ && !left_until_) {
        rest(DriverState::idle);
    }
    while (may_begin_block(now)) {
        begin_block(now);
    }
    if (under_way_ || !program_ || listens(now)) {
        return;
    }
    if (status_.state == DriverState::stopping) {
        rest(DriverState::stopped);
    } else if (next_ == program_->block_count()) {
        claim_executed();
        rest(DriverState::idle);
    } else if (status_.state == DriverState::holding && !rests_) {
        rest(DriverState::holding, status_.message);
    }
}

void RecordSession::begin_block(double now) {
    const Block& block = program_->blocks[static_cast<std::size_t>(next_)];
    status_.sent_blocks = next_ + 1;
    if (block.kind == BlockKind::dwell) {
        under_way_ = UnderWay{status_.position, now + block.duration, false};
        return;
    }
    if (block.moves()) {
        send(block, now);
        return;
    }
    const bool waits = block.kind == BlockKind::pause &&
                       (block.pause != program::PauseKind::optional_stop || optional_stop_);
    if (waits) {
        std::string why = reason_of_pause(*program_, listing_.get(), next_);
        executed();
        claim_executed();
        rest(DriverState::holding, std::move(why));
        return;
    }
    executed();
}

void RecordSession::send(const Block& block, double now) {
    AxisPositions target = status_.position; // of axes that the block does not name
    for (int n = 0; n < model_->axis_count(); ++n) {
        target[n] = block.named.contains(n) ? block.target[n] : target[n];
    }
    const AxisPositions way = target - status_.position;
    const double length = way.norm();
    const double smallest = 0.5 * std::pow(10.0, -decimals_);
    if (!(way.cwiseAbs().maxCoeff() >= smallest)) { // it is there already, as far as records can tell
        executed();
        return;
    }
    const double fastest = along(*model_, way, &MachineAxis::max_velocity);
    double speed = fastest;
    if (block.kind == BlockKind::feed) {
        constexpr double percent = 0.01;
        speed = std::min(fastest, length / block.duration * percent * status_.overrides.feed);
    }
    const double acceleration = along(*model_, way, &MachineAxis::max_acceleration);
    output_ += sender_.to(target, speed, acceleration);
    ++records_;
    status_.feed = speed;
    under_way_ = UnderWay{target, now + time_of(length, speed, acceleration), true, now, length / speed};
}

void RecordSession::hold(double /*now*/) {
    if (status_.state == DriverState::running) {
        status_.state = DriverState::holding;
        rests_ = !under_way_;
    }
}

void RecordSession::resume(double now) {
    if (status_.state == DriverState::holding) {
        status_.state = DriverState::running;
        status_.message.clear();
        rests_ = false;
        tick(now);
    }
}

void RecordSession::stop(double now) {
    if (status_.state == DriverState::running || status_.state == DriverState::holding) {
        status_.state = DriverState::stopping;
        tick(now);
    }
}

void RecordSession::emergency_stop(double /*now*/) {
    if (status_.state != DriverState::disconnected) {
        alarm("emergency stop");
    }
}

void RecordSession::reset(double now) {
    if (status_.state != DriverState::alarm) {
        return;
    }
    rest(DriverState::stopping, "The move that was under way at the alarm has not finished.");
    tick(now);
}

void RecordSession::stands_at(const AxisPositions& position) {
    if (status_.state != DriverState::idle && status_.state != DriverState::stopped) {
        throw Error(fmt::format("the table is {}", to_text(status_.state)),
                    {},
                    "enter the position when the table is at rest and unlocked");
    }
    expects(position.size() == model_->axis_count() && position.allFinite(),
            "each axis has a finite position");
    status_.position = position;
    status_.position_known = true;
    status_.position_doubt.clear();
    sender_.begin(position);
}

void RecordSession::home(double /*now*/) {
    throw Error("a table that runs records cannot be homed from Millwright");
}

void RecordSession::jog(const Jog& /*jog*/, double /*now*/) {
    throw Error("a record cannot be taken back, so this table cannot be jogged from Millwright");
}

void RecordSession::set_overrides(const Overrides& wanted) {
    constexpr int least = 10;
    constexpr int most = 200;
    status_.overrides.feed = std::clamp(wanted.feed, least, most);
}

} // namespace millwright::drivers::records
