#include "core/machine/drivers/stream/stream_driver.h"

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/units.h"

#include <fmt/format.h>

#include <utility>

namespace millwright::machine {

using kinematics::AxisKind;
using kinematics::AxisPositions;

StreamDriver::StreamDriver(std::unique_ptr<Link> link,
                           const Clock& clock,
                           std::shared_ptr<const kinematics::MachineModel> model,
                           AxisPositions position,
                           StreamOptions options)
    : link_(std::move(link)), clock_(clock), model_(std::move(model)), options_(options),
      machine_(std::move(position), {1.0}, stream_clock_, model_) {
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
}

StreamDriver::~StreamDriver() {
    close();
}

std::string StreamDriver::lost() const {
    const std::scoped_lock lock(mutex_);
    return lost_;
}

DriverStatus StreamDriver::status() const {
    DriverStatus status = machine_.status();
    if (const std::string why = lost(); !why.empty() && status.state != DriverState::disconnected) {
        status.state = DriverState::alarm;
        status.link_lost = true;
        status.message = "the link was lost: " + why;
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

std::string StreamDriver::line(const AxisPositions& position) const {
    std::string text;
    for (int n = 0; n < model_->axis_count(); ++n) {
        const bool rotary = model_->axis(n).kind == AxisKind::rotary;
        text +=
            (n == 0 ? "" : " ") + fixed(rotary ? to_degrees(position[n]) : position[n], options_.decimals);
    }
    return text + "\n";
}

void StreamDriver::connect() {
    if (machine_.status().state == DriverState::disconnected) {
        open();
        machine_.connect();
    }
}

void StreamDriver::open() {
    thread_ = {};
    link_->open();
    link_->write(heading());
    {
        const std::scoped_lock lock(mutex_);
        lost_.clear();
        last_line_.clear();
    }
    thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

void StreamDriver::run(const std::stop_token& stop) {
    double next = clock_.now();
    while (!stop.stop_requested()) {
        if (const auto why = link_->lost()) {
            machine_.emergency_stop();
            const std::scoped_lock lock(mutex_);
            lost_ = *why;
            return;
        }
        next += options_.period;
        const double left = next - clock_.now();
        constexpr double rest = 0.002; // s, where nothing moves and nobody waits
        const bool stands = machine_.status().activity == Activity::none;
        if (options_.paced && left > 0.0) {
            link_->wait(left);
        } else if (stands) {
            link_->wait(rest);
        }
        if (stands) {
            next = std::max(next, clock_.now() - options_.period);
        }
        send_sample();
    }
}

/// What is the same as the last is sent only while something moves: a standing machine needs no samples.
void StreamDriver::send_sample() {
    stream_clock_.wait(options_.period);
    const DriverStatus now = machine_.status();
    if (now.position.size() == 0) {
        return;
    }
    std::string text = line(now.position);
    const std::scoped_lock lock(mutex_);
    const bool moves = now.state == DriverState::running || now.state == DriverState::stopping;
    if (now.state == DriverState::alarm || (!moves && text == last_line_)) {
        return;
    }
    link_->write(text);
    last_line_ = std::move(text);
    ++samples_;
}

void StreamDriver::require_link() const {
    if (const std::string why = lost(); !why.empty()) {
        throw Error("the link was lost: " + why, {}, "look at the machine, then reset it");
    }
}

void StreamDriver::start(Work work) {
    require_link();
    machine_.start(std::move(work));
}

void StreamDriver::reset() {
    if (!lost().empty()) {
        open();
    }
    machine_.reset();
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
    require_link();
    machine_.jog(jog);
}

void StreamDriver::home() {
    require_link();
    machine_.home();
}

int StreamDriver::command(const std::string& lines) {
    require_link();
    return machine_.command(lines);
}

} // namespace millwright::machine
