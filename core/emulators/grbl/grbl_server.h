// An emulated Grbl at the far end of links.
#pragma once

#include "core/emulators/emulator_server.h"
#include "core/emulators/grbl/grbl_emulator.h"

#include <memory>
#include <utility>
#include <vector>

namespace millwright::emulators {

class GrblServer final : public EmulatorServer {
public:
    GrblServer(std::vector<std::unique_ptr<links::Link>> links,
               const Clock& clock,
               GrblEmulatorOptions options = {},
               double speed = 1.0,
               const links::FaultSpec& faults = {})
        : EmulatorServer(
              std::move(links), clock, std::make_unique<GrblEmulator>(std::move(options)), speed, faults) {}

    /// Asks or changes the controller; safe from any thread.
    template <class Use> auto with_controller(Use&& use) {
        return with_emulator([&](Emulator& emulator) { return use(static_cast<GrblEmulator&>(emulator)); });
    }
};

} // namespace millwright::emulators
