// A session and an emulated controller with a wire between them on which faults happen, all in one thread and
// in time that passes as fast as it is computed.
#pragma once

#include "core/base/clock.h"
#include "core/base/error.h"
#include "core/drivers/driver_status.h"
#include "core/drivers/internal/send_window.h"
#include "core/links/fault_link.h"

#include <functional>
#include <string>
#include <utility>

namespace millwright::test {

template <class Session, class Emulated> class SessionWire {
public:
    Session session;
    double now = 1000.0;
    std::string sent;                                     ///< by the session, since it was last cleared
    std::function<void(std::string& bytes)> on_the_way{}; ///< may change what the session has sent

    /// One small step of time for both ends.
    void step() { step(step_time_); }
    void step(double seconds) {
        now += seconds;
        emulated().advance(seconds);
        to_host_.send(emulated().take_output(), now);
        if (deaf_) {
            (void)to_host_.arrived(now);
        } else if (!broken()) {
            session.receive(to_host_.arrived(now), now);
        } else {
            session.lost("it broke");
        }
        happen();
        session.tick(now);
        ask_ahead();
        std::string bytes = session.take_output();
        sent += bytes;
        if (on_the_way) {
            on_the_way(bytes);
        }
        if (!broken() && !deaf_) {
            to_controller_.send(bytes, now);
            emulated().receive(to_controller_.arrived(now));
        }
    }

    template <class Done> bool run_until(const Done& done, double seconds) {
        for (const double end = now + seconds; now < end;) {
            if (done()) {
                return true;
            }
            step();
        }
        return done();
    }

    [[nodiscard]] drivers::DriverState state() const { return session.status().state; }
    bool run_to_end(double seconds = 600.0) {
        return run_until(
            [this] {
                return state() == drivers::DriverState::idle || state() == drivers::DriverState::stopped ||
                       state() == drivers::DriverState::alarm;
            },
            seconds);
    }

    /// Pulls the plug, which is reported to the session, or lets all bytes vanish without a word.
    void cut() { cut_ = true; }
    void go_deaf() { deaf_ = true; }
    [[nodiscard]] bool broken() const {
        return cut_ || to_host_.disconnected() || to_controller_.disconnected();
    }

protected:
    SessionWire(Emulated& emulated, Session its_session, double step_time)
        : session(std::move(its_session)), emulated_(&emulated), step_time_(step_time),
          to_host_({}, links::WireEnd::host), to_controller_({}, links::WireEnd::controller) {}

    /// Says hello while all is well.
    void greet() {
        session.opened(now);
        run_until([this] { return session.greeted(); }, 10.0);
    }
    void begin_faults(const links::FaultSpec& faults) {
        to_host_ = links::FaultyWire(faults, links::WireEnd::host);
        to_controller_ = links::FaultyWire(faults, links::WireEnd::controller);
        faults_ = faults;
    }

private:
    [[nodiscard]] Emulated& emulated() { return *emulated_; }

    /// As the driver's thread does.
    void ask_ahead() {
        drivers::internal::SendWindow* const window = session.send_window();
        for (bool more = window != nullptr; more;) {
            const auto question = window->question();
            const int allowed = question ? question->ask(question->wanted) : 0;
            more = question && allowed >= question->wanted;
            if (question) {
                window->answer(*question, allowed);
                session.tick(now);
            }
        }
    }

    /// Faults of the controller itself.
    void happen() {
        const std::int64_t passed = to_host_.sent() + to_controller_.sent();
        if (faults_.reset && passed >= *faults_.reset) {
            faults_.reset.reset();
            emulated().power_cycle();
        }
        if (faults_.alarm && passed >= *faults_.alarm) {
            faults_.alarm.reset();
            emulated().raise_alarm();
        }
    }

    Emulated* emulated_;
    double step_time_;
    links::FaultSpec faults_;
    links::FaultyWire to_host_, to_controller_;
    bool cut_ = false, deaf_ = false;
};

/// The time of a wire as a Clock: whoever waits lets the wire go on.
template <class Wire> class WireClock final : public Clock {
public:
    /// Waiting beyond `end` is a Defect: something does not come to its end.
    WireClock(Wire& wire, double end) : wire_(wire), end_(end) {}

    [[nodiscard]] double now() const override { return wire_.now; }
    void wait(double seconds) override {
        expects(wire_.now < end_, "the run has no end");
        for (const double until = wire_.now + seconds - 1e-9; wire_.now < until;) {
            wire_.step();
        }
    }

private:
    Wire& wire_;
    double end_;
};

} // namespace millwright::test
