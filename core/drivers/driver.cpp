#include "core/drivers/driver.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <algorithm>

namespace millwright::drivers {

namespace {

[[noreturn]] void refuse_unsupported(const Driver& driver, const std::string& what) {
    throw Error("the " + driver.name() + " driver cannot " + what);
}

} // namespace

void Driver::check(const program::Listing&, const std::filesystem::path&) const {}

void Driver::set_overrides(const Overrides&) {
    refuse_unsupported(*this, "override feeds");
}

void Driver::jog(const Jog&) {
    refuse_unsupported(*this, "jog");
}

void Driver::stop_jog() {}

void Driver::break_off(std::string) {
    stop();
}

void Driver::trust_position() {}

void Driver::stands_at(const kinematics::AxisPositions&) {
    refuse_unsupported(*this, "accept a position");
}

void Driver::enable() {
    refuse_unsupported(*this, "switch the motor power");
}

void Driver::doubt_position(std::string, bool) {}

void Driver::home() {
    refuse_unsupported(*this, "home");
}

int Driver::command(const std::string&) {
    refuse_unsupported(*this, "execute single lines");
}

int Driver::check_there(const program::Listing&) {
    refuse_unsupported(*this, "check a program without moving");
}

int Driver::load(const std::vector<std::string>&) {
    refuse_unsupported(*this, "load settings files");
}

void Driver::set_single_block(bool on) {
    if (on) {
        refuse_unsupported(*this, "run single blocks");
    }
}

void Driver::set_optional_stop(bool on) {
    if (on) {
        refuse_unsupported(*this, "handle optional stops (M1)");
    }
}

bool needs_confirmation(const DriverStatus& status, const std::vector<StoredOffset>& offsets) {
    const auto is_work_offset = [](const StoredOffset& offset) {
        constexpr std::string_view work_systems = "G54 G55 G56 G57 G58 G59";
        return work_systems.find(offset.name) != std::string_view::npos && !offset.value.isZero();
    };
    return !status.position_doubt.empty() &&
           (status.position_lost || std::ranges::any_of(offsets, is_work_offset));
}

std::string doubt_sentence(std::string_view why) {
    return fmt::format(
        "The position may be lost ({}): home the machine, set its zero, or confirm the position.", why);
}

std::string_view to_text(Activity activity) {
    switch (activity) {
    case Activity::none:
        return "nothing";
    case Activity::program:
        return "a program";
    case Activity::command:
        return "a command";
    case Activity::jog:
        return "a jog";
    case Activity::homing:
        return "homing";
    case Activity::check:
        return "a check";
    }
    return "unknown";
}

std::string_view to_text(DriverState state) {
    switch (state) {
    case DriverState::disconnected:
        return "disconnected";
    case DriverState::idle:
        return "idle";
    case DriverState::running:
        return "running";
    case DriverState::holding:
        return "holding";
    case DriverState::stopping:
        return "stopping";
    case DriverState::stopped:
        return "stopped";
    case DriverState::alarm:
        return "alarm";
    }
    return "unknown";
}

bool is_at_work(DriverState state) {
    return state == DriverState::running || state == DriverState::holding || state == DriverState::stopping;
}

std::string_view in_words(DriverState state) {
    return state == DriverState::alarm ? "in alarm" : to_text(state);
}

} // namespace millwright::drivers
