// The host's side of a conversation with a controller, without wires, threads and clocks: bytes come in,
// bytes go out, the time is passed in. Used by one thread at a time.
#pragma once

#include "core/base/error.h"
#include "core/drivers/console.h"
#include "core/drivers/driver.h"

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace millwright::drivers {

namespace internal {
class SendWindow;
}

class ControllerSession {
public:
    virtual ~ControllerSession() = default;

    // What happens to it.
    virtual void opened(double now) = 0;
    virtual void lost(const std::string& why) = 0;
    virtual void closed() = 0;
    virtual void receive(std::string_view bytes, double now) = 0;
    virtual void tick(double now) = 0;
    /// Where nothing comes in, the next tick is no later than so many s after `now`.
    [[nodiscard]] virtual double patience(double /*now*/) const {
        constexpr double usual = 0.02;
        return usual;
    }
    /// Takes the bytes that shall be sent.
    [[nodiscard]] virtual std::string take_output() { return std::exchange(output_, {}); }
    /// Takes what a person shall read of the conversation where bytes alone do not say it; number and time of
    /// the lines do not count.
    [[nodiscard]] virtual std::vector<ConsoleLine> take_console() { return {}; }

    // What it knows.
    [[nodiscard]] virtual DriverStatus status() const = 0;
    /// Whether the greeting is over, well or not.
    [[nodiscard]] virtual bool greeted() const = 0;
    [[nodiscard]] virtual bool link_lost() const = 0;
    /// After the greeting: why this is no controller of the kind; nothing if it is one.
    [[nodiscard]] virtual std::optional<Diagnostic> stranger() const = 0;

    /// What it wants to know before it sends more of a program; null: it is given programs whole.
    [[nodiscard]] virtual internal::SendWindow* send_window() { return nullptr; }

    // What a person wants, as in Driver. Each throws Error with the reason if it cannot be done now; those of
    // Driver that do nothing in other states do nothing.
    virtual void hold(double now) = 0;
    virtual void resume(double now) = 0;
    virtual void stop(double now) = 0;
    virtual void break_off(std::string, double now) { stop(now); }
    virtual void emergency_stop(double now) = 0;
    /// Before the link is dropped: stops what was begun here.
    virtual void leave(double now) { stop(now); }
    virtual void reset(double now) = 0;
    virtual void trust_position() {}
    virtual void doubt_position(std::string, bool) {}
    virtual void stands_at(const kinematics::AxisPositions&) {} ///< asked where the driver can be told alone
    virtual void home(double now) = 0;
    virtual void jog(const Jog& jog, double now) = 0;
    virtual void stop_jog(double now) = 0;
    virtual void set_overrides(const Overrides& wanted) = 0;

protected:
    ControllerSession() = default;
    ControllerSession(const ControllerSession&) = default;
    ControllerSession& operator=(const ControllerSession&) = default;

    std::string output_; ///< that shall be sent
};

} // namespace millwright::drivers
