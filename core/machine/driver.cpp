#include "core/machine/driver.h"

#include "core/base/error.h"

namespace millwright::machine {

namespace {

[[noreturn]] void refuse(const Driver& driver, const std::string& what) {
    throw Error("the " + driver.name() + " driver cannot " + what);
}

} // namespace

void Driver::set_overrides(const Overrides&) {
    refuse(*this, "override feeds");
}

void Driver::jog(const Jog&) {
    refuse(*this, "jog");
}

void Driver::stop_jog() {}

void Driver::home() {
    refuse(*this, "home");
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

} // namespace millwright::machine
