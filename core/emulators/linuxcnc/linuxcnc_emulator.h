// A LinuxCNC with its machine behind linuxcncrsh, as far as our driver talks with it: takes the bytes of the
// link and answers as man page linuxcncrsh says, and remembers what it really executed. What is emulated, and
// what is not: docs/reference/linuxcnc.md. Lengths mm, times s.
#pragma once

#include "core/emulators/emulator.h"
#include "core/kinematics/machine_model.h"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::emulators {

struct LinuxCncEmulatorOptions {
    std::string password = "EMC", enable_password = "EMCTOO";
    std::shared_ptr<const kinematics::MachineModel> model; ///< axes out of XYZABC, with XYZ
    bool homed = false; ///< begins switched on and homed, else in its emergency stop
};

/// A line of a program file that was executed.
struct LinuxCncTruthLine {
    int run = 0;           ///< counts the programs that were run, from 1
    int line = 0;          ///< of the file, from 1
    double executed = 0.0; ///< when its last motion had ended
};

struct LinuxCncTruth {
    std::vector<LinuxCncTruthLine> lines; ///< in their order; those without motion are not listed
    int runs = 0;
    int ended_runs = 0;        ///< that came to their end
    double last_motion = -1.0; ///< when it last moved; negative: never
};

class LinuxCncEmulator final : public Emulator {
public:
    /// At zero. Throws Defect without a model that has X, Y and Z.
    explicit LinuxCncEmulator(LinuxCncEmulatorOptions options);
    LinuxCncEmulator(const LinuxCncEmulator&) = delete;
    LinuxCncEmulator& operator=(const LinuxCncEmulator&) = delete;
    ~LinuxCncEmulator() override;

    void receive(std::string_view bytes) override;
    void advance(double seconds) override;
    [[nodiscard]] std::string take_output() override;
    [[nodiscard]] bool moving() const override;
    /// The emergency stop is pressed.
    void raise_alarm() override;
    void power_cycle() override;

    [[nodiscard]] double time() const;
    [[nodiscard]] kinematics::AxisPositions position() const;
    [[nodiscard]] const LinuxCncTruth& truth() const;
    /// Somebody ends the program at the machine itself.
    void abort_at_the_machine();

private:
    class Body;
    std::unique_ptr<Body> body_;
};

} // namespace millwright::emulators
