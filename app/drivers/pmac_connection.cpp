#include "app/drivers/pmac_connection.h"

#include "app/command_line/arm_choice.h"
#include "core/base/error.h"
#include "core/base/sentences.h"
#include "core/pmac/driver/arm_axes.h"

#include <fmt/format.h>

#include <cstdio>
#include <utility>

namespace millwright::app {

void warn_of_protections(const pmac::PmacDriver& driver, Clock& clock) {
    constexpr double glance = 0.005, patience = 2.0; // s
    auto off = driver.protections_off();
    for (double waited = 0.0; !off && waited < patience; waited += glance) {
        clock.wait(glance);
        off = driver.protections_off();
    }
    if (off) {
        for (const std::string& sentence : *off) {
            fmt::print(stderr, "warning: protection off: {}\n", sentence);
        }
    }
}

bool part_from(pmac::PmacDriver& driver) {
    const bool had_power = driver.any_power();
    driver.close();
    if (const std::string farewell = driver.farewell(); !farewell.empty()) {
        fmt::print(stderr, "millwright: {}\n", with_sentence(capitalised(farewell), "Inspect the machine."));
        return false;
    }
    if (driver.any_power()) {
        fmt::print(stderr, "The motors are enabled and no longer supervised.\n");
    } else if (had_power) {
        fmt::print(stderr, "The motors are disabled; --keep-power would leave them enabled.\n");
    }
    return true;
}

namespace {

std::unique_ptr<pmac::PmacDriver>
connected_driver(const std::string& port, pmac::PmacSettings settings, const SteadyClock& clock) {
    settings.patience = 10.0; // s
    settings.parting = pmac::Parting::as_found;
    auto driver = std::make_unique<pmac::PmacDriver>(links::make_link(port), clock, std::move(settings));
    driver->connect();
    return driver;
}

bool has_motor_5(pmac::PmacDriver& driver, SteadyClock& clock) {
    constexpr double glance = 0.001;
    const int number = driver.command("I500");
    drivers::DriverStatus now = driver.status();
    while (now.answer.number == number && now.answer.state == drivers::CommandAnswer::State::pending) {
        clock.wait(glance);
        now = driver.status();
    }
    return now.answer.text == "1";
}

} // namespace

std::unique_ptr<pmac::PmacDriver>
connected_pmac(const std::string& port, const std::string& arm, SteadyClock& clock) {
    const arm::ArmModel model = arm_of(arm);
    auto driver = connected_driver(port, pmac::within_limits(pmac::arm_settings(), model), clock);
    if (model.joint_count() > 4 && has_motor_5(*driver, clock)) {
        driver.reset();
        driver = connected_driver(port, pmac::within_limits(pmac::five_axis_arm_settings(), model), clock);
    }
    return driver;
}

PmacConnection::PmacConnection(const std::string& port, const std::string& arm)
    : driver_(connected_pmac(port, arm, clock_)) {
    warn_of_protections(*driver_, clock_);
}

PmacConnection::~PmacConnection() {
    (void)part_from(*driver_);
}

pmac::CardTalk PmacConnection::card() {
    return {.ask = [this](const std::string& line) { return ask(line); },
            .wait =
                [this](double seconds) {
                    check();
                    clock_.wait(seconds);
                }};
}

void PmacConnection::give_power() {
    constexpr double glance = 0.02, patience = 5.0; // s
    driver_->let_lines_give_power(); // a busy computer lets the card take it away between two commands
    driver_->enable();
    for (double waited = 0.0; waited < patience; waited += glance) {
        check();
        clock_.wait(glance);
        const drivers::DriverStatus now = driver_->status();
        if (now.state == drivers::DriverState::alarm) {
            throw Error(now.message);
        }
        if (now.powered && now.state == drivers::DriverState::idle) {
            return;
        }
    }
    throw Error("the motors could not be enabled", {}, "check that all of them are active (Ix00 = 1)");
}

void PmacConnection::let_lines_give_power() {
    driver_->let_lines_give_power();
}

void PmacConnection::check() {
    if (!cancelled_ && interrupt_.token().stop_requested()) {
        cancelled_ = true;
        throw Cancelled{};
    }
}

void PmacConnection::wait_for_rest() {
    constexpr double glance = 0.005;
    while (driver_->status().activity == drivers::Activity::command) {
        check();
        clock_.wait(glance);
    }
}

std::string PmacConnection::ask(const std::string& line) {
    check();
    constexpr double glance = 0.001;
    if (pmac::PmacDriver::needs_rest(line)) {
        wait_for_rest();
    }
    const int number = driver_->command(line);
    drivers::DriverStatus now = driver_->status();
    while (now.answer.number == number && now.answer.state == drivers::CommandAnswer::State::pending) {
        clock_.wait(glance);
        now = driver_->status();
    }
    if (now.answer.state != drivers::CommandAnswer::State::done) {
        throw Error(now.answer.text.empty() ? "the card did not accept '" + line + "'" : now.answer.text);
    }
    return now.answer.text;
}

} // namespace millwright::app
