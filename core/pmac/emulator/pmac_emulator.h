// A Delta Tau PMAC-Lite with motors on its channels: takes the characters of a port and answers as the manual
// says, runs its programs, and moves what hangs on it in servo cycles of its own time. What is emulated, and
// what is not: docs/reference/pmac.md. Counts, s.
#pragma once

#include "core/emulators/emulator.h"
#include "core/pmac/emulator/pmac_plant.h"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::pmac {

struct PmacEmulatorOptions {
    std::vector<PmacPlant> plants{}; ///< of the channels from the first; those not given are as by default
    int channels = 4;                ///< 4, or 8 with the second row of outputs
};

class PmacEmulator final : public emulators::Emulator {
public:
    /// From the factory, all motors at rest at 0. Throws Error for a number of channels that no card has.
    explicit PmacEmulator(PmacEmulatorOptions options = {});
    PmacEmulator(const PmacEmulator&) = delete;
    PmacEmulator& operator=(const PmacEmulator&) = delete;
    ~PmacEmulator() override;

    void receive(std::string_view bytes) override;
    void advance(double seconds) override;
    [[nodiscard]] std::string take_output() override;
    [[nodiscard]] bool moving() const override;
    /// The amplifiers report a fault and drive nothing, until clear_faults().
    void raise_alarm() override;
    /// The amplifiers have no power; the card is not notified.
    void emergency_stop() override;
    /// What SAVE stored is in force; programs and definitions stay (battery), positions do not.
    void power_cycle() override;

    /// Everything at the machine is in order again; nothing moves by that.
    void clear_faults();
    /// The encoder's plug of a channel (from 1) is out, or in again.
    void unplug_encoder(int channel, bool out = true);

    // What hangs on it, as it truly is. Motors and channels from 1.
    [[nodiscard]] double time() const;
    [[nodiscard]] double position(int motor) const; ///< as #nP reports it, unrounded
    [[nodiscard]] double command(int motor) const;
    [[nodiscard]] double speed(int channel) const; ///< counts/s
    [[nodiscard]] double output(int motor) const;  ///< bits
    [[nodiscard]] bool enabled(int motor) const;
    [[nodiscard]] bool program_runs(int system) const;
    [[nodiscard]] std::int64_t moves(int system) const;        ///< of motion programs that were begun
    [[nodiscard]] double last_motion() const;                  ///< when anything moved last; negative: never
    [[nodiscard]] double variable(char kind, int index) const; ///< kind: I, P, Q or M

    // The dual-ported RAM as the computer sees it: offsets in bytes.
    [[nodiscard]] std::uint16_t shared_16(int offset) const;
    void set_shared_16(int offset, std::uint16_t value);
    [[nodiscard]] std::int32_t shared_32(int offset) const;
    void set_shared_32(int offset, std::int32_t value);
    /// Pulses of EQU1, the interrupt of the hand-shake, since this was last asked.
    [[nodiscard]] int take_compare_pulses();

private:
    class Body;
    std::unique_ptr<Body> body_;
};

} // namespace millwright::pmac
