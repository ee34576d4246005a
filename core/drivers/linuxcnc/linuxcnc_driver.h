// LinuxCNC behind the Driver interface, over its linuxcncrsh (TCP): programs as files that LinuxCNC opens
// itself, so it has to see the folder where they are written. What is claimed as executed, and what happens
// when something goes wrong: docs/reference/linuxcnc.md.
#pragma once

#include "core/drivers/session_driver.h"

#include <filesystem>
#include <memory>
#include <string>

namespace millwright::drivers {

struct LinuxCncOptions {
    std::string password = "EMC", enable_password = "EMCTOO";
    std::string axes = "XYZ";             ///< letters out of XYZABC, in this order; X Y Z first
    std::filesystem::path program_folder; ///< empty: the system's for temporary files
    double jog_acceleration = 500.0;      ///< mm/s^2, no less than the machine's
};

namespace linuxcnc {
class ShellSession;
}

class LinuxCncDriver final : public SessionDriver {
public:
    static constexpr int standard_port = 5007;

    /// `clock` must outlive it. Throws Error for axes that LinuxCNC's shell does not have.
    LinuxCncDriver(std::unique_ptr<links::Link> link, const Clock& clock, LinuxCncOptions options = {});
    LinuxCncDriver(const LinuxCncDriver&) = delete;
    LinuxCncDriver& operator=(const LinuxCncDriver&) = delete;
    ~LinuxCncDriver() override;

    // connect() throws Error also if a password is refused. A LinuxCNC in its emergency stop, or switched
    // off, is connected, in DriverState::alarm; reset() ends that and switches the machine on. Jogs are of X,
    // Y and Z; overrides of the feed alone: there is none for rapids, and this linuxcncrsh does not survive
    // the spindle's.

    [[nodiscard]] std::string name() const override { return "linuxcnc"; }
    [[nodiscard]] Capabilities capabilities() const override;
    /// Uses the listing alone, written to a file. Throws Error if that cannot be written, or has no end.
    void start(Work work) override;
    int command(const std::string& lines) override;

private:
    [[nodiscard]] linuxcnc::ShellSession& talk() const;
    void remove_program();

    LinuxCncOptions options_;
    int programs_ = 0;
    std::filesystem::path program_file_;
};

} // namespace millwright::drivers
