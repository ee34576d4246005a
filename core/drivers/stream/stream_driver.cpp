#include "core/drivers/stream/stream_driver.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace millwright::drivers {

using kinematics::AxisPositions;

namespace {

StreamOptions checked_stream(const StreamOptions& options) {
    constexpr double shortest = 0.0005;
    constexpr double longest = 1.0;
    if (!(options.period >= shortest && options.period <= longest)) {
        throw Error(fmt::format(
            "a sampling period of {} s is not between {} and {}", options.period, shortest, longest));
    }
    return options;
}

} // namespace

StreamDriver::StreamDriver(std::unique_ptr<links::Link> link,
                           const Clock& clock,
                           std::shared_ptr<const kinematics::MachineModel> model,
                           AxisPositions position,
                           StreamOptions options)
    : link_(std::move(link)), clock_(clock), model_(std::move(model)), options_(checked_stream(options)),
      machine_(std::move(position), {1.0}, stream_clock_, model_),
      sender_({options_.record, options_.period, options_.decimals}, *model_) {
    known_ = options.known;
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
    able.reports.execution = sender_.asks();
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

void StreamDriver::connect() {
    if (machine_.status().state == DriverState::disconnected) {
        if (options_.paced && !sender_.asks()) {
            constexpr double usual = 100.0; // as long as positions are
            const AxisPositions position = AxisPositions::Constant(model_->axis_count(), usual);
            sender_.begin(position);
            links::expect_carried(*link_, sender_.to(position).size(), options_.period);
        }
        link_->open();
        machine_.connect();
        begin();
    }
}

/// Over a link that was just opened.
void StreamDriver::begin() {
    sender_.forget_bytes();
    if (!sender_.heading().empty()) {
        link_->write(sender_.heading());
    }
    follow();
}

/// From its present position.
void StreamDriver::follow() {
    const AxisPositions position = machine_.status().position;
    sender_.begin(position); // it is there already
    {
        const std::scoped_lock lock(mutex_);
        lost_.clear();
        last_line_ = sender_.line(position);
        told_place_ = sender_.writes_records();
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
        if (stands || sender_.asks()) {
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
        in_flight_ = sender_.asks();
    }
    stream_clock_.wait(options_.period);
    const DriverStatus now = machine_.status();
    if (now.position.size() == 0 || now.state == DriverState::alarm) {
        land();
        return true;
    }
    std::string here = sender_.line(now.position);
    const bool in_motion = now.state == DriverState::running || now.state == DriverState::stopping;
    if (!in_motion && here == last_line_) {
        land();
        return true;
    }
    const bool first = !std::exchange(told_place_, true);
    samples_ += first ? 1 : 0;
    if (const auto why = exchange(first ? last_line_ : std::string(), now.position, stop)) {
        lose(*why);
        return false;
    }
    last_line_ = std::move(here);
    known_ = known_ || !options_.record || !options_.record->relative; // it went there
    ++samples_;
    land();
    return true;
}

/// Sends `before` and the position, and waits for the answer where one is awaited. Why that failed; nothing
/// if it did not.
std::optional<std::string> StreamDriver::exchange(const std::string& before,
                                                  const AxisPositions& position,
                                                  const std::stop_token& stop) {
    if (!sender_.asks()) {
        link_->write(before + sender_.to(position));
        return std::nullopt;
    }
    if (const auto unasked = hear()) {
        return fmt::format("the machine sent '{}' before record {} was sent", unasked->line, samples_ + 1);
    }
    link_->write(before + sender_.to(position));
    const RecordFormat& format = *options_.record;
    const double end = clock_.now() + format.patience;
    while (!stop.stop_requested()) {
        if (const auto answer = hear()) {
            return answer->kind == PointSender::Answer::right
                       ? std::nullopt
                       : std::optional(fmt::format(
                             "the machine answered '{}' to record {}", answer->line, samples_ + 1));
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
    if (work.program) {
        sender_.expect_all_told(*work.program, *model_);
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
