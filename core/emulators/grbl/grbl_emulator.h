// A Grbl 1.1, grblHAL or FluidNC controller with its machine, in this program: takes the bytes of a serial
// port and answers as the real one does, and remembers what it really executed. What is emulated, and what is
// not: docs/reference/grbl.md. mm, of rotary axes degrees, s.
#pragma once

#include "core/emulators/emulator.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace millwright::emulators {

enum class EmulatedFirmware { grbl, grblhal, fluidnc };

struct GrblEmulatorOptions {
    EmulatedFirmware firmware = EmulatedFirmware::grbl;
    std::string axes = "XYZ";            ///< three to six letters: XYZ, and any of ABCUVW behind
    std::filesystem::path eeprom_file{}; ///< read now, written with each change; empty: neither
    bool line_numbers = false;           ///< built with USE_LINE_NUMBERS
    bool echo = false;                   ///< built with REPORT_ECHO_LINE_RECEIVED
    bool mist = false;                   ///< built with ENABLE_M7
    bool keep_truth = true;              ///< remembers every line
    /// Of a grblHAL: ? ! ~ act in $ lines, too; without it they are text there.
    bool printable_realtime = true;
    /// Height of what a probe touches, in machine coordinates; none: nothing is there.
    std::function<double(double x, double y)> surface{};
};

/// One line that was accepted.
struct TruthLine {
    std::string text;       ///< as Grbl read it: no blanks, no comments, capitals
    double accepted = 0.0;  ///< when it was acknowledged
    double executed = -1.0; ///< when its last motion ended; negative: never
};

struct Truth {
    std::vector<TruthLine> lines;
    double travelled = 0.0;    ///< way of the tool so far, mm
    double last_motion = -1.0; ///< when it was last moving
    int lost_bytes = 0;        ///< that found the receive buffer full, or came while the EEPROM was written
};

class GrblEmulator final : public Emulator {
public:
    /// Switched on; the greeting is in the first output. Throws Error for an EEPROM file that cannot be read,
    /// and for axes that no such controller has.
    explicit GrblEmulator(GrblEmulatorOptions options = {});
    GrblEmulator(const GrblEmulator&) = delete;
    GrblEmulator& operator=(const GrblEmulator&) = delete;
    ~GrblEmulator() override;

    void receive(std::string_view bytes) override;
    /// Throws Error if a changed EEPROM cannot be written.
    void advance(double seconds) override;
    [[nodiscard]] std::string take_output() override;

    [[nodiscard]] double time() const;
    [[nodiscard]] std::array<double, 3> position() const;  ///< of X, Y and Z, machine coordinates
    [[nodiscard]] double axis_position(char letter) const; ///< of one axis that it has
    [[nodiscard]] bool moving() const override;
    [[nodiscard]] int planned_blocks() const;
    [[nodiscard]] Truth truth() const;

    /// What happens to machines. A limit switch that is hit works only with hard limits on ($21).
    void hit_limit_switch();
    /// As if a limit switch had been hit, whatever the settings.
    void raise_alarm() override;
    /// The switch is at its reset input: as a soft reset, an alarm if it moved.
    void emergency_stop() override;
    void set_door(bool open);
    void break_limit_switches();
    void power_cycle() override;

private:
    class Body;
    std::unique_ptr<Body> body_;
};

// An emulated Grbl at the far end of links.

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
