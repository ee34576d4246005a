// An emulated Grbl in real time at a pseudo-terminal, for a person to connect to.
#pragma once

#include "core/emulators/grbl/grbl_emulator.h"
#include "core/links/pseudo_terminal.h"
#include "tests/core/emulators/grbl/stored_settings.h"

#include <memory>
#include <string>
#include <vector>

namespace millwright::test {

class GrblBench {
public:
    /// Accelerates by 500 mm/s^2 along X, Y and Z, goes 3000 mm/min at most.
    explicit GrblBench(emulators::GrblEmulatorOptions options = {}) {
        auto terminal = std::make_unique<links::PseudoTerminal>();
        terminal->open();
        port_ = terminal->path().string();
        std::vector<std::unique_ptr<links::Link>> links;
        links.push_back(std::move(terminal));
        options.surface = [](double, double) { return part_height; };
        server_ = std::make_unique<emulators::GrblServer>(std::move(links), clock_, std::move(options));
        server_->with_controller([](emulators::GrblEmulator& grbl) {
            test::store_settings(grbl,
                                 "$120=500\n$121=500\n$122=500\n$110=3000\n$111=3000\n$112=3000\n$20=0\n");
        });
    }

    static constexpr double acceleration = 500.0; // mm/s^2
    static constexpr double part_height = -7.25;  ///< mm, machine coordinates: where a probe touches

    /// Homing by switches, of a machine that is small enough not to take long.
    void install_switches() {
        server_->with_controller([](emulators::GrblEmulator& grbl) {
            test::store_settings(grbl, "$130=30\n$131=30\n$132=30\n$24=300\n$25=1200\n$22=1\n");
        });
    }
    /// All that it has accepted so far.
    [[nodiscard]] std::vector<std::string> lines() {
        std::vector<std::string> texts;
        server_->with_controller([&](emulators::GrblEmulator& grbl) {
            for (const emulators::TruthLine& line : grbl.truth().lines) {
                texts.push_back(line.text);
            }
        });
        return texts;
    }

    [[nodiscard]] const std::string& port() const { return port_; }
    [[nodiscard]] bool moving() {
        return server_->with_controller([](emulators::GrblEmulator& grbl) { return grbl.moving(); });
    }
    /// s of the controller.
    [[nodiscard]] double time() {
        return server_->with_controller([](emulators::GrblEmulator& grbl) { return grbl.time(); });
    }
    [[nodiscard]] double last_motion() {
        return server_->with_controller(
            [](emulators::GrblEmulator& grbl) { return grbl.truth().last_motion; });
    }
    [[nodiscard]] std::array<double, 3> position() {
        return server_->with_controller([](emulators::GrblEmulator& grbl) { return grbl.position(); });
    }
    [[nodiscard]] double axis_position(char letter) {
        return server_->with_controller(
            [letter](emulators::GrblEmulator& grbl) { return grbl.axis_position(letter); });
    }
    void raise_alarm() {
        server_->with_controller([](emulators::GrblEmulator& grbl) { grbl.raise_alarm(); });
    }
    /// The cable is pulled.
    void vanish() { server_.reset(); }
    [[nodiscard]] bool there() const { return server_ != nullptr; }

private:
    SteadyClock clock_;
    std::string port_;
    std::unique_ptr<emulators::GrblServer> server_;
};

} // namespace millwright::test
