// LinuxCNC behind the Driver interface, over its linuxcncrsh (TCP): programs as files that LinuxCNC opens
// itself, so it has to see the folder where they are written. What is claimed as executed, and what happens
// when something goes wrong: docs/reference/linuxcnc.md.
#pragma once

#include "core/machine/clock.h"
#include "core/machine/console.h"
#include "core/machine/driver.h"
#include "core/machine/links/link.h"

#include <filesystem>
#include <memory>
#include <string>

namespace millwright::machine {

struct LinuxCncOptions {
    std::string password = "EMC", enable_password = "EMCTOO";
    std::string axes = "XYZ";             ///< letters out of XYZABC, in this order; X Y Z first
    std::filesystem::path program_folder; ///< empty: the system's for temporary files
    double jog_acceleration = 500.0;      ///< mm/s^2, no less than the machine's
};

class LinuxCncDriver final : public Driver {
public:
    static constexpr int standard_port = 5007;

    /// `clock` must outlive it. Throws Error for axes that LinuxCNC's shell does not have.
    LinuxCncDriver(std::unique_ptr<Link> link, const Clock& clock, LinuxCncOptions options = {});
    LinuxCncDriver(const LinuxCncDriver&) = delete;
    LinuxCncDriver& operator=(const LinuxCncDriver&) = delete;
    ~LinuxCncDriver() override;

    [[nodiscard]] std::string name() const override { return "linuxcnc"; }
    [[nodiscard]] DriverStatus status() const override;
    [[nodiscard]] Capabilities capabilities() const override;
    /// Throws Error if nobody answers or a password is refused. A LinuxCNC in its emergency stop, or switched
    /// off, is connected, in DriverState::alarm.
    void connect() override;
    /// Uses the listing alone, written to a file. Throws Error if that cannot be written, or has no end.
    void start(Work work) override;
    void hold() override;
    void resume() override;
    void stop() override;
    void emergency_stop() override;
    /// Makes a lost link again; ends the emergency stop and switches the machine on.
    void reset() override;
    void close() noexcept override;
    /// Of the feed alone: there is none for rapids, and this linuxcncrsh does not survive the spindle's.
    void set_overrides(const Overrides& wanted) override;
    /// X, Y and Z.
    void jog(const Jog& jog) override;
    void stop_jog() override;
    void home() override;
    int command(const std::string& lines) override;
    [[nodiscard]] Console* console() override;

private:
    struct Body;
    std::unique_ptr<Body> body_;
};

} // namespace millwright::machine
