#include "core/machine/drivers/grbl/grbl_driver.h"

#include "core/base/error.h"
#include "core/machine/drivers/grbl/internal/console_tap.h"
#include "core/machine/drivers/grbl/internal/session.h"
#include "core/machine/drivers/grbl/settings.h"

#include <algorithm>
#include <mutex>
#include <stop_token>
#include <thread>
#include <utility>

namespace millwright::machine {

using grbl::Session;

/// The session, its link, and the thread that carries bytes between them.
struct GrblDriver::Body {
    std::unique_ptr<Link> link;
    const Clock& clock;
    mutable std::mutex mutex; ///< guards the session
    Session session;
    Console console;
    grbl::ConsoleTap tap{console};
    std::jthread thread;

    Body(std::unique_ptr<Link> its_link, const Clock& its_clock, const GrblOptions& options)
        : link(std::move(its_link)), clock(its_clock),
          session({options.one_by_one, options.poll_interval, options.patience, options.greeting_time}) {}

    /// One command, its bytes sent before anybody else's.
    template <class Command> auto with_session(Command&& command) {
        const std::scoped_lock lock(mutex);
        struct Sender {
            Body& body;
            ~Sender() {
                const std::string bytes = body.session.take_output();
                body.tap.sent(bytes, body.clock.now());
                body.link->write(bytes);
            }
        } const sender{*this};
        return command(session, clock.now());
    }

    void run(const std::stop_token& stop) {
        constexpr double tick = 0.02;
        while (!stop.stop_requested()) {
            link->wait(tick);
            with_session([this](Session& now, double time) {
                const std::string bytes = link->read();
                tap.received(bytes, time);
                now.receive(bytes, time);
                if (const auto why = link->lost(); why && !now.link_lost()) {
                    tap.note("the link was lost: " + *why, time);
                    now.lost(*why);
                }
                now.tick(time);
            });
        }
    }

    void open() {
        link->open();
        with_session([](Session& now, double time) { now.opened(time); });
        thread = std::jthread([this](const std::stop_token& stop) { run(stop); });
    }

    void shut() {
        thread = {};
        link->close();
        with_session([](Session& now, double) { now.closed(); });
    }

    [[nodiscard]] DriverStatus status() const {
        const std::scoped_lock lock(mutex);
        return session.status();
    }

    template <class Done> void wait_until(const Done& done) {
        while (true) {
            {
                const std::scoped_lock lock(mutex);
                if (done(session)) {
                    return;
                }
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
    }

    void greet() {
        open();
        wait_until([](const Session& now) { return now.greeted(); });
    }
};

GrblDriver::GrblDriver(std::unique_ptr<Link> link, const Clock& clock, GrblOptions options)
    : body_(std::make_unique<Body>(std::move(link), clock, options)) {}

GrblDriver::~GrblDriver() {
    close();
}

DriverStatus GrblDriver::status() const {
    return body_->status();
}

Capabilities GrblDriver::capabilities() const {
    using kinematics::AxisKind;
    return {.plans = true,
            .axes = {{'X', AxisKind::linear}, {'Y', AxisKind::linear}, {'Z', AxisKind::linear}},
            .overrides = true,
            .other_overrides = true,
            .jog = true,
            .home = true,
            .command = true,
            .probe = true,
            .settings = true,
            .single_block = true,
            .piecewise = true,
            .dialect = gcode::Dialect::grbl};
}

GrblReadout GrblDriver::readout() const {
    const std::scoped_lock lock(body_->mutex);
    const grbl::Readout& known = body_->session.readout();
    return {.version = known.version,
            .settings = known.settings,
            .planner_blocks = known.planner_blocks,
            .buffer_bytes = known.buffer_bytes};
}

void GrblDriver::check(const gcode::Listing& listing, const std::filesystem::path& file) const {
    (void)grbl::program_lines(listing, file);
}

void GrblDriver::connect() {
    if (status().state != DriverState::disconnected) {
        return;
    }
    body_->greet();
    const DriverStatus now = status();
    if (now.state == DriverState::alarm && readout().settings.empty()) {
        body_->shut();
        throw Error(body_->link->name() + ": " + now.message, {}, "is it the right port, and switched on?");
    }
}

void GrblDriver::start(Work work) {
    expects(work.listing != nullptr, "Grbl is given a program's text");
    grbl::ProgramLines lines = grbl::program_lines(*work.listing, {});
    body_->with_session(
        [&](Session& now, double time) { now.start(std::move(lines), time, work.allowed_blocks); });
}

void GrblDriver::hold() {
    body_->with_session([](Session& now, double time) { now.hold(time); });
}

void GrblDriver::resume() {
    body_->with_session([](Session& now, double time) { now.resume(time); });
}

void GrblDriver::stop() {
    body_->with_session([](Session& now, double time) { now.stop(time); });
}

void GrblDriver::emergency_stop() {
    body_->with_session([](Session& now, double time) { now.emergency_stop(time); });
}

void GrblDriver::reset() {
    bool lost = false;
    {
        const std::scoped_lock lock(body_->mutex);
        lost = body_->session.link_lost();
    }
    if (lost) {
        body_->shut();
        body_->greet();
    }
    body_->with_session([](Session& now, double time) { now.reset(time); });
    body_->wait_until([](const Session& now) { return now.greeted(); });
}

void GrblDriver::close() noexcept {
    try {
        stop();
        body_->wait_until([](const Session& now) { return now.status().state != DriverState::stopping; });
        body_->shut();
    } catch (const std::exception&) {
        body_->thread = {};
        body_->link->close(); // a controller without its host stops by itself when its buffers are empty
    }
}

void GrblDriver::set_overrides(const Overrides& wanted) {
    body_->with_session([&](Session& now, double) { now.set_overrides(wanted); });
}

void GrblDriver::jog(const Jog& jog) {
    body_->with_session([&](Session& now, double time) { now.jog(jog, time); });
}

void GrblDriver::stop_jog() {
    body_->with_session([](Session& now, double time) { now.stop_jog(time); });
}

void GrblDriver::home() {
    body_->with_session([](Session& now, double time) { now.home(time); });
}

int GrblDriver::command(const std::string& lines) {
    grbl::ProgramLines ready = grbl::command_lines(lines);
    return body_->with_session(
        [&](Session& now, double time) { return now.command(std::move(ready), time); });
}

void GrblDriver::set_single_block(bool on) {
    body_->with_session([&](Session& now, double) { now.set_single_block(on); });
}

void GrblDriver::allow(int blocks) {
    body_->with_session([&](Session& now, double) { now.allow(blocks); });
}

MachineLimits GrblDriver::limits() const {
    const std::scoped_lock lock(body_->mutex);
    const std::map<int, double>& settings = body_->session.readout().settings;
    const auto setting = [&settings](int number) {
        const auto found = settings.find(number);
        return found == settings.end() ? std::nullopt : std::optional(found->second);
    };
    constexpr double seconds_per_minute = 60.0;
    MachineLimits limits;
    for (int n = 0; n < 3 && !settings.empty(); ++n) {
        MachineLimits::Axis axis{.letter = "XYZ"[n], .min = {}, .max = {}, .speed = {}};
        if (const auto rate = setting(110 + n)) {
            axis.speed = *rate / seconds_per_minute;
        }
        const auto travel = setting(130 + n);
        if (travel && setting(22).value_or(0.0) > 0.0) {
            axis.min = -*travel;
            axis.max = 0.0;
        }
        limits.axes.push_back(axis);
    }
    limits.spindle_rpm = setting(30);
    return limits;
}

std::vector<ControllerSetting> GrblDriver::settings() const {
    const std::scoped_lock lock(body_->mutex);
    std::vector<ControllerSetting> table;
    for (const auto& [number, value] : body_->session.readout().settings) {
        const GrblSetting* known = find_grbl_setting(number);
        const GrblSetting words =
            known != nullptr ? *known
                             : GrblSetting{number, "Not of Grbl 1.1", "", "see the controller's makers"};
        table.push_back({"$" + std::to_string(number), value, words.title, words.unit, words.explanation});
    }
    return table;
}

std::vector<StoredOffset> GrblDriver::stored_offsets() const {
    const std::scoped_lock lock(body_->mutex);
    std::vector<StoredOffset> table;
    for (const auto& [name, axes] : body_->session.readout().offsets) {
        table.push_back({name, kinematics::AxisPositions{Vec3(axes[0], axes[1], axes[2])}});
    }
    return table;
}

Console* GrblDriver::console() {
    return &body_->console;
}

} // namespace millwright::machine
