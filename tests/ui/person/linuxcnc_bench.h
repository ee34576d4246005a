// An emulated LinuxCNC in real time behind its linuxcncrsh on a TCP port, for a person to connect to.
#pragma once

#include "core/base/clock.h"
#include "core/emulators/emulator.h"
#include "core/emulators/linuxcnc/linuxcnc_emulator.h"
#include "core/links/tcp.h"
#include "tests/support/machines.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace millwright::test {

/// Begins in its emergency stop.
class LinuxCncBench {
public:
    /// `homed`: begins switched on and homed, else in its emergency stop.
    explicit LinuxCncBench(const std::string& machine_id = "router-xyz", bool homed = false) {
        auto listener = std::make_unique<links::TcpServer>(0);
        listener->open();
        port_ = listener->port();
        std::vector<std::unique_ptr<links::Link>> links;
        links.push_back(std::move(listener));
        emulators::LinuxCncEmulatorOptions options;
        options.homed = homed;
        options.model = std::make_shared<const kinematics::MachineModel>(machine(machine_id));
        server_ = std::make_unique<emulators::EmulatorServer>(
            std::move(links), clock_, std::make_unique<emulators::LinuxCncEmulator>(std::move(options)));
    }

    [[nodiscard]] std::string address() const { return "tcp:127.0.0.1:" + std::to_string(port_); }
    template <class Use> auto with(Use&& use) {
        return server_->with_emulator(
            [&](emulators::Emulator& it) { return use(static_cast<emulators::LinuxCncEmulator&>(it)); });
    }
    [[nodiscard]] bool moving() {
        return with([](emulators::LinuxCncEmulator& it) { return it.moving(); });
    }
    /// Without a motion, s of its own time: also while it is held.
    [[nodiscard]] double rested_for() {
        return with([](emulators::LinuxCncEmulator& it) { return it.time() - it.truth().last_motion; });
    }
    [[nodiscard]] double position(Eigen::Index axis) {
        return with([axis](emulators::LinuxCncEmulator& it) { return it.position()[axis]; });
    }
    [[nodiscard]] int runs() {
        return with([](emulators::LinuxCncEmulator& it) { return it.truth().runs; });
    }
    void press_emergency_stop() {
        with([](emulators::LinuxCncEmulator& it) { it.raise_alarm(); });
    }

private:
    SteadyClock clock_;
    std::uint16_t port_ = 0;
    std::unique_ptr<emulators::EmulatorServer> server_;
};

} // namespace millwright::test
