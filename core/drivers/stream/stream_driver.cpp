#include "core/drivers/stream/stream_driver.h"

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace millwright::drivers {

using kinematics::AxisKind;
using kinematics::AxisPositions;

StreamDriver::StreamDriver(std::unique_ptr<links::Link> link,
                           const Clock& clock,
                           std::shared_ptr<const kinematics::MachineModel> model,
                           AxisPositions position,
                           StreamOptions options)
    : link_(std::move(link)), clock_(clock), model_(std::move(model)), options_(options),
      machine_(std::move(position), {1.0}, stream_clock_, model_),
      record_path_(options_.record && options_.record->relative, options_.period, options_.decimals) {
    known_ = options.known;
    constexpr double shortest = 0.0005;
    constexpr double longest = 1.0;
    constexpr int most_decimals = 9;
    if (!(options.period >= shortest && options.period <= longest)) {
        throw Error(fmt::format(
            "a sampling period of {} s is not between {} and {}", options.period, shortest, longest));
    }
    if (options.decimals < 0 || options.decimals > most_decimals) {
        throw Error(fmt::format("{} decimals are not between 0 and {}", options.decimals, most_decimals));
    }
    for (const kinematics::MachineAxis& axis : model_->axes()) {
        linear_.push_back(axis.kind == AxisKind::linear);
    }
    if (options_.record) {
        record_text_.emplace(*options_.record, *model_, options_.decimals);
    }
}

StreamDriver::~StreamDriver() {
    close();
}

std::string StreamDriver::lost() const {
    const std::scoped_lock lock(mutex_);
    return lost_;
}

Capabilities StreamDriver::capabilities() const {
    Capabilities able = machine_.capabilities();
    able.reports.position = able.reports.spindle = false;
    able.reports.execution = awaits_answers();
    return able;
}

DriverStatus StreamDriver::status() const {
    const std::scoped_lock lock(mutex_);
    DriverStatus status = in_flight_ ? proven_ : machine_.status();
    status.position_known = known_;
    if (!lost_.empty() && status.state != DriverState::disconnected) {
        status.state = DriverState::alarm;
        status.activity = Activity::none;
        status.link_lost = true;
        status.message = links::loss_sentence(lost_);
    }
    return status;
}

std::string StreamDriver::heading() const {
    std::string text = fmt::format("# millwright-stream 1 period_s {}", options_.period);
    for (const kinematics::MachineAxis& axis : model_->axes()) {
        text += fmt::format(" {} {}", axis.letter, axis.kind == AxisKind::rotary ? "deg" : "mm");
    }
    return text + "\n";
}

std::vector<double> StreamDriver::as_written(const AxisPositions& position) const {
    std::vector<double> values;
    for (int n = 0; n < model_->axis_count(); ++n) {
        values.push_back(linear_[static_cast<std::size_t>(n)] ? position[n] : to_degrees(position[n]));
    }
    return values;
}

std::string StreamDriver::line(const AxisPositions& position) const {
    std::string text;
    for (const double value : as_written(position)) {
        text += (text.empty() ? "" : " ") + fixed(value, options_.decimals);
    }
    return text + "\n";
}

std::string StreamDriver::text_for(const AxisPositions& position) {
    return record_text_ ? record_text_->written(record_path_.to(as_written(position), linear_)) +
                              options_.record->ending
                        : line(position);
}

void StreamDriver::connect() {
    if (machine_.status().state == DriverState::disconnected) {
        if (options_.paced && !awaits_answers()) {
            constexpr double usual = 100.0; // as long as positions are
            const AxisPositions position = AxisPositions::Constant(model_->axis_count(), usual);
            record_path_.begin(as_written(position));
            links::expect_carried(*link_, text_for(position).size(), options_.period);
        }
        link_->open();
        machine_.connect();
        begin();
    }
}

/// Over a link that was just opened.
void StreamDriver::begin() {
    inbox_.clear();
    if (!record_text_) {
        link_->write(heading());
    }
    follow();
}

/// From its present position.
void StreamDriver::follow() {
    const AxisPositions position = machine_.status().position;
    if (record_text_) { // it stands there already
        record_path_.begin(as_written(position));
    }
    {
        const std::scoped_lock lock(mutex_);
        lost_.clear();
        last_line_ = line(position);
        told_place_ = record_text_.has_value();
        in_flight_ = false;
    }
    thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

void StreamDriver::lose(const std::string& why) {
    machine_.emergency_stop();
    {
        const std::scoped_lock lock(mutex_);
        lost_ = why;
    }
    landed_.notify_all();
}

void StreamDriver::run(const std::stop_token& stop) {
    double next = clock_.now();
    while (!stop.stop_requested()) {
        if (const auto why = link_->lost()) {
            lose(*why);
            return;
        }
        next += options_.period;
        const double left = next - clock_.now();
        constexpr double rest = 0.002; // s, where nothing moves and no caller waits
        const bool stands = !moves(machine_.status());
        if (options_.paced && left > 0.0) {
            link_->wait(left);
        } else if (stands) {
            link_->wait(rest);
        }
        if (stands || awaits_answers()) {
            next = std::max(next, clock_.now() - options_.period);
        }
        if (!send_sample(stop)) {
            return;
        }
    }
}

/// A machine that is braking for a hold moves, too.
bool StreamDriver::moves(const DriverStatus& status) {
    return status.state == DriverState::running || status.state == DriverState::stopping ||
           (status.velocity.size() > 0 && status.velocity.cwiseAbs().maxCoeff() > 0.0);
}

/// The record that was sent is answered, or needs no answer, or there was none.
void StreamDriver::land() {
    {
        const std::scoped_lock lock(mutex_);
        in_flight_ = false;
    }
    landed_.notify_all();
}

/// What is the same as the last is sent only while something moves: a standing machine needs no samples. The
/// first motion over a link begins with the sample of where it begins, so that nothing is sent before a
/// person wants a motion. While an answer is awaited the stream's time stands, and with it the machine. False
/// when the link is gone.
bool StreamDriver::send_sample(const std::stop_token& stop) {
    {
        const std::scoped_lock lock(mutex_);
        proven_ = machine_.status();
        in_flight_ = awaits_answers();
    }
    stream_clock_.wait(options_.period);
    const DriverStatus now = machine_.status();
    if (now.position.size() == 0 || now.state == DriverState::alarm) {
        land();
        return true;
    }
    std::string here = line(now.position);
    const bool in_motion = now.state == DriverState::running || now.state == DriverState::stopping;
    if (!in_motion && here == last_line_) {
        land();
        return true;
    }
    const bool first = !std::exchange(told_place_, true);
    samples_ += first ? 1 : 0;
    if (const auto why = exchange((first ? last_line_ : std::string()) + text_for(now.position), stop)) {
        lose(*why);
        return false;
    }
    last_line_ = std::move(here);
    known_ = known_ || !options_.record || !options_.record->relative; // it went there
    ++samples_;
    land();
    return true;
}

std::optional<std::string> StreamDriver::next_answer() {
    inbox_.add(link_->read());
    return inbox_.next();
}

/// Sends, and waits for the answer where one is awaited. Why that failed; nothing if it did not.
std::optional<std::string> StreamDriver::exchange(const std::string& text, const std::stop_token& stop) {
    if (!awaits_answers()) {
        link_->write(text);
        return std::nullopt;
    }
    if (const auto unasked = next_answer()) {
        return fmt::format("the machine sent '{}' before record {} was sent", *unasked, samples_ + 1);
    }
    link_->write(text);
    const RecordFormat& format = *options_.record;
    const double end = clock_.now() + format.patience;
    while (!stop.stop_requested()) {
        if (const auto answer = next_answer()) {
            return *answer == format.answer
                       ? std::nullopt
                       : std::optional(
                             fmt::format("the machine answered '{}' to record {}", *answer, samples_ + 1));
        }
        if (const auto why = link_->lost()) {
            return why;
        }
        if (clock_.now() > end) {
            return fmt::format("no answer to record {} within {} s", samples_ + 1, format.patience);
        }
        constexpr double glance = 0.01;
        link_->wait(glance);
    }
    return "closed";
}

/// What a person begins is seen in the next status: it does not hide behind a record that is on its way.
template <class Act> auto StreamDriver::between_records(const Act& act) {
    std::unique_lock lock(mutex_);
    landed_.wait(lock, [this] { return !in_flight_ || !lost_.empty(); });
    if (!lost_.empty()) {
        throw Error(links::loss_sentence(lost_), {}, "inspect the machine, then reset it");
    }
    return act();
}

void StreamDriver::start(Work work) {
    if (record_text_ && work.program) {
        record_text_->expect_all_told(*work.program, *model_);
    }
    between_records([&] { machine_.start(std::move(work)); });
}

void StreamDriver::reset() {
    if (!lost().empty()) {
        thread_ = {};
        link_->open();
        begin();
    }
    machine_.reset();
}

void StreamDriver::stands_at(const AxisPositions& position) {
    if (const std::string why = lost(); !why.empty()) {
        throw Error(links::loss_sentence(why), {}, "inspect the machine, then reset it");
    }
    if (const DriverState now = machine_.status().state;
        now != DriverState::idle && now != DriverState::stopped) {
        throw Error(fmt::format("the machine is {}", to_text(now)),
                    {},
                    "enter the position when the machine is at rest");
    }
    thread_ = {}; // it would follow to there
    machine_.stands_at(position);
    known_ = true;
    follow();
}

void StreamDriver::close() noexcept {
    try {
        machine_.stop();
        constexpr double patience = 10.0; // s: longer than any machine brakes
        for (double waited = 0.0; waited < patience; waited += options_.period) {
            if (machine_.status().state != DriverState::stopping || !lost().empty()) {
                break;
            }
            std::this_thread::sleep_for(std::chrono::duration<double>(options_.period));
        }
        thread_ = {};
        machine_.close();
        link_->close();
    } catch (const std::exception&) {
        thread_ = {};
        link_->close(); // a machine without samples stands where the last one was
    }
}

void StreamDriver::jog(const Jog& jog) {
    between_records([&] { machine_.jog(jog); });
}

void StreamDriver::home() {
    between_records([&] { machine_.home(); });
}

int StreamDriver::command(const std::string& lines) {
    return between_records([&] { return machine_.command(lines); });
}

} // namespace millwright::drivers
