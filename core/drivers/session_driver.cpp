#include "core/drivers/session_driver.h"

#include "core/base/error.h"
#include "core/drivers/console_tap.h"
#include "core/drivers/controller_session.h"
#include "core/drivers/internal/send_window.h"
#include "core/links/link.h"

#include <chrono>
#include <optional>
#include <stop_token>
#include <thread>
#include <utility>

namespace millwright::drivers {

struct SessionDriver::Body {
    std::unique_ptr<links::Link> link;
    const Clock& clock;
    mutable FairMutex mutex; ///< guards the session and the tap
    std::unique_ptr<ControllerSession> session;
    Console console;
    ConsoleTap tap;
    std::jthread thread;

    Body(std::unique_ptr<links::Link> its_link,
         const Clock& its_clock,
         std::unique_ptr<ControllerSession> its_session,
         const ConsoleWords& words)
        : link(std::move(its_link)), clock(its_clock), session(std::move(its_session)), tap(console, words) {}

    void send() {
        const std::string bytes = session->take_output();
        tap.sent(bytes, clock.now());
        tap.told(session->take_console(), clock.now());
        link->write(bytes);
    }

    void carry() {
        const std::scoped_lock lock(mutex);
        const double now = clock.now();
        const std::string bytes = link->read();
        tap.received(bytes, now);
        session->receive(bytes, now);
        if (const auto why = link->lost(); why && !session->link_lost()) {
            tap.note(links::loss_sentence(*why), now);
            session->lost(*why);
        }
        session->tick(now);
        send();
    }

    [[nodiscard]] double patience() const {
        const std::scoped_lock lock(mutex);
        return session->patience(clock.now());
    }

    void run(const std::stop_token& stop) {
        while (!stop.stop_requested()) {
            link->wait(patience());
            carry();
            while (ask_ahead()) {
            }
        }
    }

    /// Whether there may be more to ask.
    bool ask_ahead() {
        std::optional<internal::SendWindow::Question> question;
        {
            const std::scoped_lock lock(mutex);
            const internal::SendWindow* const window = session->send_window();
            question = window != nullptr ? window->question() : std::nullopt;
        }
        if (!question) {
            return false;
        }
        const int allowed = question->ask(question->wanted); // may wait for a disk
        const std::scoped_lock lock(mutex);
        session->send_window()->answer(*question, allowed);
        session->tick(clock.now());
        send();
        return allowed >= question->wanted;
    }

    void greet() {
        link->open();
        {
            const std::scoped_lock lock(mutex);
            session->opened(clock.now());
            send();
        }
        thread = std::jthread([this](const std::stop_token& stop) { run(stop); });
        wait_until([](const ControllerSession& now) { return now.greeted(); });
    }

    /// Throws Error if it is somebody else, or moves for somebody else; then there is no link.
    void meet() {
        greet();
        std::optional<Diagnostic> stranger;
        {
            const std::scoped_lock lock(mutex);
            stranger = session->stranger();
        }
        if (stranger) {
            shut();
            stranger->message = link->name() + ": " + stranger->message;
            throw Error(std::move(*stranger));
        }
    }

    void shut() {
        thread = {};
        link->close();
        const std::scoped_lock lock(mutex);
        session->closed();
    }

    template <class Done> void wait_until(const Done& done) {
        while (true) {
            {
                const std::scoped_lock lock(mutex);
                if (done(*session)) {
                    return;
                }
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
    }
};

SessionDriver::SessionDriver(std::unique_ptr<links::Link> link,
                             const Clock& clock,
                             std::unique_ptr<ControllerSession> session,
                             const ConsoleWords& words)
    : body_(std::make_unique<Body>(std::move(link), clock, std::move(session), words)) {}

SessionDriver::~SessionDriver() {
    SessionDriver::close();
}

SessionDriver::Turn::Turn(SessionDriver& driver)
    : driver_(driver), lock_(driver.body_->mutex), now_(driver.body_->clock.now()) {}

SessionDriver::Turn::~Turn() {
    driver_.body_->send();
}

ControllerSession& SessionDriver::session() const {
    return *body_->session;
}

FairMutex& SessionDriver::session_mutex() const {
    return body_->mutex;
}

std::string SessionDriver::address() const {
    return body_->link->name();
}

DriverStatus SessionDriver::status() const {
    const std::scoped_lock lock(body_->mutex);
    return body_->session->status();
}

void SessionDriver::connect() {
    if (status().state != DriverState::disconnected) {
        return;
    }
    body_->meet();
}

void SessionDriver::hold() {
    const Turn turn(*this);
    session().hold(turn.now());
}

void SessionDriver::resume() {
    const Turn turn(*this);
    session().resume(turn.now());
}

void SessionDriver::stop() {
    const Turn turn(*this);
    session().stop(turn.now());
}

void SessionDriver::break_off(std::string why) {
    const Turn turn(*this);
    session().break_off(std::move(why), turn.now());
}

void SessionDriver::emergency_stop() {
    const Turn turn(*this);
    session().emergency_stop(turn.now());
}

void SessionDriver::reset() {
    bool lost = false;
    {
        const std::scoped_lock lock(body_->mutex);
        lost = body_->session->link_lost();
    }
    if (lost) {
        body_->shut();
        body_->meet();
    }
    {
        const Turn turn(*this);
        session().reset(turn.now());
    }
    body_->wait_until([](const ControllerSession& now) { return now.greeted(); });
}

void SessionDriver::trust_position() {
    const Turn turn(*this);
    session().trust_position();
}

void SessionDriver::doubt_position(std::string why, bool lost) {
    const Turn turn(*this);
    session().doubt_position(std::move(why), lost);
}

void SessionDriver::close() noexcept {
    try {
        leave();
        body_->wait_until(
            [](const ControllerSession& now) { return now.status().state != DriverState::stopping; });
        body_->shut();
    } catch (const std::exception&) {
        body_->thread = {};
        body_->link->close(); // a controller without its host stops when its buffers are empty
    }
}

void SessionDriver::leave() {
    const Turn turn(*this);
    session().leave(turn.now());
}

void SessionDriver::set_overrides(const Overrides& wanted) {
    const Turn turn(*this);
    session().set_overrides(wanted);
}

void SessionDriver::jog(const Jog& jog) {
    const Turn turn(*this);
    session().jog(jog, turn.now());
}

void SessionDriver::stop_jog() {
    const Turn turn(*this);
    session().stop_jog(turn.now());
}

void SessionDriver::home() {
    const Turn turn(*this);
    session().home(turn.now());
}

Console* SessionDriver::console() {
    return &body_->console;
}

} // namespace millwright::drivers
