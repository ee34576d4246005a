// A session with linuxcncrsh and an emulated LinuxCNC with a wire between them.
#pragma once

#include "core/base/files.h"
#include "core/drivers/linuxcnc/internal/shell_session.h"
#include "core/emulators/linuxcnc/linuxcnc_emulator.h"
#include "core/jobs/job.h"
#include "tests/core/drivers/session_wire.h"
#include "tests/support/machines.h"
#include "tests/support/scratch_folder.h"

#include <memory>
#include <string>

namespace millwright::test {

/// What is there before the wire.
struct LinuxCncHolder {
    ScratchFolder folder;
    emulators::LinuxCncEmulator linuxcnc{
        {.model = std::make_shared<const kinematics::MachineModel>(machine("router-xyz"))}};
};

class LinuxCncWire : public LinuxCncHolder,
                     public SessionWire<drivers::linuxcnc::ShellSession, emulators::LinuxCncEmulator> {
public:
    /// Switched on and homed.
    explicit LinuxCncWire(const links::FaultSpec& faults = {})
        : SessionWire(linuxcnc, drivers::linuxcnc::ShellSession(), 0.02) {
        greet();
        session.reset(now);
        run_until([this] { return state() == drivers::DriverState::idle; }, 10.0);
        session.home(now);
        run_to_end();
        begin_faults(faults);
    }

    void start(const program::Listing& listing) {
        const drivers::linuxcnc::ProgramFile file = drivers::linuxcnc::program_file(listing, {}, ++programs_);
        const std::filesystem::path path = folder / "program.ngc";
        write_file(path, file.text);
        session.start(listing, file, path.string(), now);
    }
    void start(const std::string& text) { start(*jobs::text_job(text, "test.ngc").listing); }

private:
    int programs_ = 0;
};

/// Its session as a Driver.
class LinuxCncWireDriver final : public drivers::Driver {
public:
    explicit LinuxCncWireDriver(LinuxCncWire& wire) : wire_(wire) {}

    [[nodiscard]] std::string name() const override { return "linuxcnc"; }
    [[nodiscard]] drivers::DriverStatus status() const override { return wire_.session.status(); }
    [[nodiscard]] drivers::Capabilities capabilities() const override {
        using kinematics::AxisKind;
        drivers::Capabilities able;
        able.axes = {{'X', AxisKind::linear}, {'Y', AxisKind::linear}, {'Z', AxisKind::linear}};
        able.takes = drivers::Capabilities::Takes::text;
        able.overrides = drivers::Capabilities::OverrideRange::feed;
        return able;
    }
    void connect() override {}
    void start(drivers::Work work) override { wire_.start(*work.listing); }
    void hold() override { wire_.session.hold(wire_.now); }
    void resume() override { wire_.session.resume(wire_.now); }
    void stop() override { wire_.session.stop(wire_.now); }
    void emergency_stop() override { wire_.session.emergency_stop(wire_.now); }
    void reset() override { wire_.session.reset(wire_.now); }
    void close() noexcept override {}
    void set_overrides(const drivers::Overrides& wanted) override { wire_.session.set_overrides(wanted); }

private:
    LinuxCncWire& wire_;
};

} // namespace millwright::test
