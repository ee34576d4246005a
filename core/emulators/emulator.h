// A controller with its machine, in this program: takes the bytes of a link and answers as the real one does.
// Without threads and clocks: time is what advance() adds. Used by one thread at a time.
#pragma once

#include "core/base/clock.h"
#include "core/base/fair_mutex.h"
#include "core/links/fault_link.h"
#include "core/links/link.h"

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace millwright::emulators {

class Emulator {
public:
    virtual ~Emulator() = default;

    virtual void receive(std::string_view bytes) = 0;
    /// It has no room for more: whoever sends has to wait.
    [[nodiscard]] virtual bool full() const { return false; }
    /// Lets `seconds` >= 0 pass.
    virtual void advance(double seconds) = 0;
    /// Takes what it has sent.
    [[nodiscard]] virtual std::string take_output() = 0;
    [[nodiscard]] virtual bool moving() const = 0;

    /// What happens to machines: somebody or something stops it at once.
    virtual void raise_alarm() = 0;
    /// Its emergency stop was pressed: an alarm, where the controller knows nothing else.
    virtual void emergency_stop() { raise_alarm(); }
    /// It was switched off and on again, and knows nothing of what came before.
    virtual void power_cycle() = 0;
};

// An emulated controller at the far end of links: carries bytes and lets its time pass with a clock, in a
// thread of its own.

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
