// A session with linuxcncrsh and an emulated LinuxCNC with a wire between them.
#pragma once

#include "core/base/files.h"
#include "core/machine/drivers/linuxcnc/internal/shell_session.h"
#include "core/machine/emulators/linuxcnc/linuxcnc_emulator.h"
#include "core/machine/job.h"
#include "tests/core/machine/drivers/session_wire.h"
#include "tests/support/machines.h"
#include "tests/support/scratch_folder.h"

#include <memory>
#include <string>

namespace millwright::test {

/// What is there before the wire.
struct LinuxCncHolder {
    ScratchFolder folder;
    machine::LinuxCncEmulator linuxcnc{
        {.model = std::make_shared<const kinematics::MachineModel>(machine("router-xyz"))}};
};

class LinuxCncWire : public LinuxCncHolder,
                     public SessionWire<machine::linuxcnc::ShellSession, machine::LinuxCncEmulator> {
public:
    /// Switched on and homed.
    explicit LinuxCncWire(const machine::FaultSpec& faults = {})
        : SessionWire(linuxcnc, machine::linuxcnc::ShellSession(), 0.02) {
        greet();
        session.reset(now);
        run_until([this] { return state() == machine::DriverState::idle; }, 10.0);
        session.home(now);
        run_to_end();
        begin_faults(faults);
    }

    void start(const gcode::Listing& listing) {
        const machine::linuxcnc::ProgramFile file = machine::linuxcnc::program_file(listing, {}, ++programs_);
        const std::filesystem::path path = folder / "program.ngc";
        write_file(path, file.text);
        session.start(listing, file, path.string(), now);
    }
    void start(const std::string& text) { start(*machine::text_job(text, "test.ngc").listing); }

private:
    int programs_ = 0;
};

/// Its session as a Driver.
class LinuxCncWireDriver final : public machine::Driver {
public:
    explicit LinuxCncWireDriver(LinuxCncWire& wire) : wire_(wire) {}

    [[nodiscard]] std::string name() const override { return "linuxcnc"; }
    [[nodiscard]] machine::DriverStatus status() const override { return wire_.session.status(); }
    [[nodiscard]] machine::Capabilities capabilities() const override {
        using kinematics::AxisKind;
        machine::Capabilities able;
        able.axes = {{'X', AxisKind::linear}, {'Y', AxisKind::linear}, {'Z', AxisKind::linear}};
        able.plans = able.overrides = true;
        return able;
    }
    void connect() override {}
    void start(machine::Work work) override { wire_.start(*work.listing); }
    void hold() override { wire_.session.hold(wire_.now); }
    void resume() override { wire_.session.resume(wire_.now); }
    void stop() override { wire_.session.stop(wire_.now); }
    void emergency_stop() override { wire_.session.emergency_stop(wire_.now); }
    void reset() override { wire_.session.reset(wire_.now); }
    void close() noexcept override {}
    void set_overrides(const machine::Overrides& wanted) override { wire_.session.set_overrides(wanted); }

private:
    LinuxCncWire& wire_;
};

} // namespace millwright::test
