#include "core/emulators/emulator.h"

#include "core/base/error.h"

#include <algorithm>
#include <exception>
#include <utility>

namespace millwright::emulators {

EmulatorServer::EmulatorServer(std::vector<std::unique_ptr<links::Link>> links,
                               const Clock& clock,
                               std::unique_ptr<Emulator> emulator,
                               double speed,
                               const links::FaultSpec& faults)
    : links_(std::move(links)), clock_(clock), speed_(speed), faults_(faults),
      emulator_(std::move(emulator)) {
    expects(!links_.empty() && speed > 0.0, "a controller is served somewhere, and its time passes");
    thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

std::string EmulatorServer::failure() const {
    const std::scoped_lock lock(mutex_);
    return failure_;
}

std::int64_t EmulatorServer::heard() const {
    const std::scoped_lock lock(mutex_);
    return heard_;
}

void EmulatorServer::wait_for_host(std::optional<double> silence) {
    const std::scoped_lock lock(mutex_);
    longest_silence_ = silence;
    silence_ = owed_ = 0.0;
}

void EmulatorServer::reset_when_opened(bool on) {
    const std::scoped_lock lock(mutex_);
    reset_when_opened_ = on;
}

void EmulatorServer::run(const std::stop_token& stop) noexcept {
    double last = clock_.now();
    while (!stop.stop_requested()) {
        constexpr double idle_wait = 0.02;
        constexpr double busy_wait = 0.001;
        links_.front()->wait(
            links_.size() == 1 && !with_emulator([](const Emulator& emulator) { return emulator.moving(); })
                ? idle_wait
                : busy_wait);
        const std::scoped_lock lock(mutex_);
        try {
            turn(last);
        } catch (const std::exception& failure) {
            failure_ = failure.what();
            return;
        }
    }
}

void EmulatorServer::turn(double& last) {
    const double now = clock_.now();
    // A computer that is too slow makes time go slower. Catching up would take longer each lap, in silence.
    constexpr double longest_lap = 0.05; // s
    const double lap = std::clamp(now - std::exchange(last, now), 0.0, longest_lap);
    const double most = longest_silence_ ? std::max(0.0, *longest_silence_ - silence_) : longest_lap * speed_;
    // What it stood still for between two words of a lively host is made up for behind the next one.
    const double due = lap * speed_ + owed_;
    const double passes = std::min(due, most);
    owed_ = longest_silence_ ? std::min(due - passes, longest_lap * speed_) : 0.0;
    emulator_->advance(passes);
    silence_ += passes;
    std::string heard;
    int visits = 0;
    for (const auto& link : links_) {
        heard += emulator_->full() ? std::string() : link->read();
        visits += link->visits();
    }
    silence_ = heard.empty() ? silence_ : 0.0;
    heard_ += static_cast<std::int64_t>(heard.size());
    passed_ += static_cast<std::int64_t>(heard.size());
    if (std::exchange(visits_, visits) != visits && reset_when_opened_) {
        emulator_->power_cycle(); // and what was sent meanwhile is lost
    } else {
        emulator_->receive(heard);
    }
    happen();
    const std::string said = emulator_->take_output();
    passed_ += static_cast<std::int64_t>(said.size());
    for (const auto& link : links_) {
        link->write(said);
    }
}

void EmulatorServer::happen() {
    if (faults_.reset && passed_ >= *faults_.reset) {
        faults_.reset.reset();
        emulator_->power_cycle();
    }
    if (faults_.alarm && passed_ >= *faults_.alarm) {
        faults_.alarm.reset();
        emulator_->raise_alarm();
    }
    if (faults_.emergency_stop && passed_ >= *faults_.emergency_stop) {
        faults_.emergency_stop.reset();
        emulator_->emergency_stop();
    }
}

} // namespace millwright::emulators
