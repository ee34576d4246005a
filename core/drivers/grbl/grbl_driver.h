// Grbl 1.1, grblHAL and FluidNC behind the Driver interface: three axes or more, G-code as text, over a
// serial port or TCP. What is claimed as executed, and what happens when something goes wrong:
// docs/reference/grbl.md.
#pragma once

#include "core/drivers/grbl/firmware.h"
#include "core/drivers/session_driver.h"

#include <filesystem>
#include <map>
#include <memory>
#include <string>

namespace millwright::drivers {

struct GrblOptions {
    bool one_by_one = false;    ///< each line waits for the answer to the last; else character counting
    double poll_interval = 0.1; ///< s between questions for the status
    double patience = 2.0;      ///< s without a byte after which the controller counts as silent
    double greeting_time = 4.0; ///< s in which a controller has to greet; one with a boot loader takes two
};

/// What is known of the controller beyond DriverStatus. mm.
struct GrblReadout {
    GrblFirmware firmware = GrblFirmware::grbl;
    std::string version;            ///< as 1.1h; empty before there was a link
    std::string build;              ///< as 20190825; empty: not reported
    std::string axes = "XYZ";       ///< letters, in the order of the positions
    std::map<int, double> settings; ///< $$
    int planner_blocks = 15, buffer_bytes = 128;
    bool mist = false; ///< built with M7
    /// It greeted when the link was made, or was silent until it was reset: what moved was cut off.
    bool began_anew = false;
};

namespace grbl {
class GrblSession;
}

class GrblDriver final : public SessionDriver {
public:
    /// `clock` must outlive it.
    GrblDriver(std::unique_ptr<links::Link> link, const Clock& clock, GrblOptions options = {});

    [[nodiscard]] std::string name() const override { return "grbl"; }
    /// "grblHAL 1.1f (20240817)".
    [[nodiscard]] std::string firmware() const override;
    [[nodiscard]] Capabilities capabilities() const override;
    [[nodiscard]] GrblReadout readout() const;
    void check(const program::Listing& listing, const std::filesystem::path& file) const override;

    // connect() resets the controller, if nothing is moving, and asks it for version and settings; waits for
    // each of both at most the greeting time. Throws Error also if the machine is moving already. A
    // controller that is locked is connected, in DriverState::alarm; reset() unlocks it.

    /// Uses the listing alone. Throws Error with its line for what must not be sent.
    void start(Work work) override;
    /// G-code, settings ($110=500) and questions ($N). Throws Error for lines that must not be sent.
    int command(const std::string& lines) override;
    /// Check mode ($C). Its end resets the controller, and modes are set as they were before. Throws Error
    /// also for lines that store offsets, which Grbl does in check mode too, and while G92 or a tool length
    /// is in force.
    int check_there(const program::Listing& listing) override;
    /// Lines that the controller has already, up to 20, are executed first.
    void set_single_block(bool on) override;
    /// Travel is known of a machine that homes: machine coordinates go from -travel to 0, or as its firmware
    /// sets zero. An axis whose travel is not reported has none here.
    [[nodiscard]] MachineLimits limits() const override;
    [[nodiscard]] std::vector<ControllerSetting> settings() const override;
    [[nodiscard]] std::vector<StoredOffset> stored_offsets() const override;

    /// What a person should know of the way the controller is set up, in sentences.
    [[nodiscard]] std::vector<std::string> remarks() const override;

private:
    [[nodiscard]] grbl::GrblSession& talk() const;
};

} // namespace millwright::drivers
