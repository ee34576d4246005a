// Emulated controllers at the other end of a wire, on the command line.
#pragma once

#include "core/emulators/emulator.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace CLI {
class App;
} // namespace CLI

namespace millwright::app {

/// What the options --pty, --tcp, --bind, --faults, --speed and --wait-for-host say.
struct EmulationChoice {
    std::string pty;
    int tcp = -1;
    std::string bind = "127.0.0.1";
    std::string faults;
    double speed = 1.0;
    std::optional<double> wait_for_host; ///< s, see EmulatorServer
    bool reset_when_opened = false;      ///< of Grbl alone
};

/// Adds them to `command`.
void add_emulation_options(CLI::App& command, EmulationChoice& choice);

/// Serves until somebody ends it, then tells by `last_words` how it was. `name` is what reaches people. The
/// exit code. Throws Error.
[[nodiscard]] int serve(const EmulationChoice& choice,
                        const std::string& name,
                        const std::function<std::unique_ptr<emulators::Emulator>()>& make,
                        const std::function<void(const emulators::Emulator&)>& last_words = {});

} // namespace millwright::app
