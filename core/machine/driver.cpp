#include "core/machine/driver.h"

namespace millwright::machine {

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
