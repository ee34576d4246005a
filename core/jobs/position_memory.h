// What outlasts a connection: that the machine behind a controller may not stand where the controller says.
// Cut off in motion, unlocked and linked again, Grbl looks as if nothing had happened.
#pragma once

#include <filesystem>
#include <string>

namespace millwright::drivers {
class Driver;
struct DriverStatus;
} // namespace millwright::drivers

namespace millwright::jobs {

/// Of one controller. Nothing is on disk unless something is in doubt, or a program or a command runs: if the
/// controller is found reset after a broken link, or after Millwright was killed, it was cut off in motion.
class PositionMemory {
public:
    /// `controller` tells it from others that are remembered in `folder`: its kind and address.
    PositionMemory(std::filesystem::path folder, std::string controller);

    /// After connect(): a doubt that was there at the last look is there again, whatever else speaks against
    /// the position. What cannot be read is a doubt, too.
    void remind(drivers::Driver& driver);
    /// Remembers what is in doubt now; of a disconnected driver nothing is known. Throws Error if it cannot
    /// be written, once for each change.
    void keep(const drivers::DriverStatus& status);

private:
    std::filesystem::path folder_, file_;
    std::string controller_;
    std::string kept_;         ///< what was last kept; empty: nothing
    bool kept_lost_ = false;   ///< DriverStatus::position_lost, of that
    bool kept_moving_ = false; ///< a program or a command was running when it was last seen
};

} // namespace millwright::jobs
