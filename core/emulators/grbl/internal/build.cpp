#include "core/emulators/grbl/internal/build.h"

namespace millwright::emulators::internal {

Sizes sizes_of(EmulatedFirmware firmware) {
    switch (firmware) {
    case EmulatedFirmware::grblhal:
        return {.planner_blocks = 35, .segments = 9, .receive_bytes = 1024, .longest_line = 256};
    case EmulatedFirmware::fluidnc:
        return {.planner_blocks = 15, .segments = 11, .receive_bytes = 128, .longest_line = 255};
    case EmulatedFirmware::grbl:
        break;
    }
    return {};
}

} // namespace millwright::emulators::internal
