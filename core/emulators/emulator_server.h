// An emulated controller at the far end of links: carries bytes and lets its time pass with a clock, in a
// thread of its own.
#pragma once

#include "core/base/clock.h"
#include "core/base/fair_mutex.h"
#include "core/emulators/emulator.h"
#include "core/links/fault_link.h"
#include "core/links/link.h"

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

namespace millwright::emulators {

class EmulatorServer {
public:
    /// Serves opened `links`, all of which speak to the one controller; `speed` is machine seconds per
    /// second. Of `faults` those of the controller happen here (reset, alarm); those of the wire belong to
    /// the links.
    EmulatorServer(std::vector<std::unique_ptr<links::Link>> links,
                   const Clock& clock,
                   std::unique_ptr<Emulator> emulator,
                   double speed = 1.0,
                   const links::FaultSpec& faults = {});
    EmulatorServer(const EmulatorServer&) = delete;
    EmulatorServer& operator=(const EmulatorServer&) = delete;
    ~EmulatorServer() = default;

    /// The controller's time stands still when it has heard nothing for so many of its seconds, so that a
    /// host on a busy computer is not taken for a cut cable; nothing: it never waits, as is the beginning. Of
    /// a host that speaks every few silences it runs at its true speed all the same.
    void wait_for_host(std::optional<double> silence);
    /// The controller loses its power for a moment whenever a program connects, as boards do that are wired
    /// to DTR.
    void reset_when_opened(bool on);
    /// Bytes that have come from hosts.
    [[nodiscard]] std::int64_t heard() const;
    /// Why it no longer serves; empty while it does.
    [[nodiscard]] std::string failure() const;

    /// Asks or changes the controller; safe from any thread.
    template <class Use> auto with_emulator(Use&& use) {
        const std::scoped_lock lock(mutex_);
        return use(*emulator_);
    }

private:
    void run(const std::stop_token& stop) noexcept;
    void turn(double& last);
    void happen();

    std::vector<std::unique_ptr<links::Link>> links_;
    const Clock& clock_;
    double speed_;
    links::FaultSpec faults_;
    mutable FairMutex mutex_; ///< guards what follows
    std::int64_t passed_ = 0; ///< bytes both ways
    std::int64_t heard_ = 0;  ///< those from hosts
    std::unique_ptr<Emulator> emulator_;
    std::string failure_;
    std::optional<double> longest_silence_; ///< of the controller's time
    double owed_ = 0.0;                     ///< of it, that a short wait took, s
    double silence_ = 0.0;
    bool reset_when_opened_ = false;
    int visits_ = 0; ///< to all links, so far
    std::jthread thread_;
};

} // namespace millwright::emulators
