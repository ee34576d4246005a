// What the drivers of controllers have in common that are talked with: a session that knows the protocol, a
// link, and a thread that carries bytes between the two.
#pragma once

#include "core/base/clock.h"
#include "core/base/fair_mutex.h"
#include "core/drivers/console.h"
#include "core/drivers/driver.h"
#include "core/links/link.h"

#include <memory>
#include <mutex>
#include <string>

namespace millwright::drivers {

class ControllerSession;
struct ConsoleWords;

class SessionDriver : public Driver {
public:
    SessionDriver(const SessionDriver&) = delete;
    SessionDriver& operator=(const SessionDriver&) = delete;
    ~SessionDriver() override;

    [[nodiscard]] std::string address() const override;
    [[nodiscard]] DriverStatus status() const override;
    /// Throws Error if there is no answer, or another kind of controller answers.
    void connect() override;
    void hold() override;
    void resume() override;
    void stop() override;
    void break_off(std::string why) override;
    void emergency_stop() override;
    /// Makes a lost link again; throws Error as connect() does, and is disconnected then.
    void reset() override;
    void trust_position() override;
    void doubt_position(std::string why, bool lost) override;
    void close() noexcept override;
    void set_overrides(const Overrides& wanted) override;
    void jog(const Jog& jog) override;
    void stop_jog() override;
    void home() override;
    [[nodiscard]] Console* console() override;

protected:
    /// `clock` must outlive it.
    SessionDriver(std::unique_ptr<links::Link> link,
                  const Clock& clock,
                  std::unique_ptr<ControllerSession> session,
                  const ConsoleWords& words);

    /// The session, for as long as this lives: no other thread touches it, and the bytes that it has to send
    /// are sent before those of any other.
    class Turn {
    public:
        explicit Turn(SessionDriver& driver);
        Turn(const Turn&) = delete;
        Turn& operator=(const Turn&) = delete;
        ~Turn();

        [[nodiscard]] double now() const { return now_; } ///< of the clock, s

    private:
        SessionDriver& driver_;
        std::scoped_lock<FairMutex> lock_;
        double now_;
    };

    [[nodiscard]] ControllerSession& session() const;
    /// For callers that look at the session and change nothing.
    [[nodiscard]] FairMutex& session_mutex() const;

private:
    void leave();

    struct Body;
    std::unique_ptr<Body> body_;
};

} // namespace millwright::drivers
