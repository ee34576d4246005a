#include "core/machine/drivers/linuxcnc/linuxcnc_driver.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "core/machine/drivers/linuxcnc/internal/shell_session.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <mutex>
#include <stop_token>
#include <thread>
#include <utility>

namespace millwright::machine {

using linuxcnc::ShellSession;

/// The session, its link, and the thread that carries bytes between them.
struct LinuxCncDriver::Body {
    std::unique_ptr<Link> link;
    const Clock& clock;
    LinuxCncOptions options;
    mutable std::mutex mutex; ///< guards the session
    ShellSession session;
    Console console;
    std::string received; ///< a line that has no end yet
    int programs = 0;
    std::filesystem::path program_file;
    std::jthread thread;

    Body(std::unique_ptr<Link> its_link, const Clock& its_clock, LinuxCncOptions its_options)
        : link(std::move(its_link)), clock(its_clock), options(std::move(its_options)),
          session({.password = options.password,
                   .enable_password = options.enable_password,
                   .axes = options.axes,
                   .jog_acceleration = options.jog_acceleration}) {}

    /// One command, its bytes sent before anybody else's.
    template <class Command> auto with_session(Command&& command) {
        const std::scoped_lock lock(mutex);
        struct Sender {
            Body& body;
            ~Sender() {
                const std::string bytes = body.session.take_output();
                body.note(bytes, true);
                body.link->write(bytes);
            }
        } const sender{*this};
        return command(session, clock.now());
    }

    void note(const std::string& bytes, bool sent) {
        std::string line = sent ? std::string() : std::exchange(received, {});
        for (const char c : bytes) {
            if (c != '\r' && c != '\n') {
                line += c;
            } else if (!line.empty()) {
                const bool asks =
                    sent ? line.starts_with("get ") : !line.starts_with("SET") && !line.starts_with("HELLO");
                const bool wrong =
                    line.ends_with("NAK") || (line.starts_with("ERROR ") && line != "ERROR OK");
                const ConsoleKind kind = wrong  ? ConsoleKind::fault
                                         : asks ? (sent ? ConsoleKind::query : ConsoleKind::report)
                                         : sent ? ConsoleKind::line
                                                : ConsoleKind::answer;
                console.add(clock.now(), sent, kind, std::exchange(line, {}));
            }
        }
        if (!sent) {
            received = std::move(line);
        }
    }

    void run(const std::stop_token& stop) {
        constexpr double tick = 0.02;
        while (!stop.stop_requested()) {
            link->wait(tick);
            with_session([this](ShellSession& now, double time) {
                const std::string bytes = link->read();
                note(bytes, false);
                now.receive(bytes, time);
                if (const auto why = link->lost(); why && !now.link_lost()) {
                    console.add(time, false, ConsoleKind::fault, "the link was lost: " + *why);
                    now.lost(*why);
                }
                now.tick(time);
            });
        }
    }

    void greet() {
        link->open();
        with_session([](ShellSession& now, double time) { now.opened(time); });
        thread = std::jthread([this](const std::stop_token& stop) { run(stop); });
        wait_until([](const ShellSession& now) { return now.greeted(); });
    }

    void shut() {
        thread = {};
        link->close();
        with_session([](ShellSession& now, double) { now.closed(); });
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

    void remove_program() {
        std::error_code ignored;
        if (!program_file.empty()) {
            std::filesystem::remove(program_file, ignored);
        }
    }
};

LinuxCncDriver::LinuxCncDriver(std::unique_ptr<Link> link, const Clock& clock, LinuxCncOptions options) {
    const bool known =
        options.axes.starts_with("XYZ") && std::string("XYZABC").starts_with(options.axes.substr(0, 3)) &&
        options.axes.find_first_not_of("XYZABC") == std::string::npos && options.axes.size() <= 6;
    if (!known) {
        throw Error("LinuxCNC's axes are XYZ, and any of ABC behind them, not " + options.axes);
    }
    if (options.program_folder.empty()) {
        options.program_folder = std::filesystem::temp_directory_path();
    }
    body_ = std::make_unique<Body>(std::move(link), clock, std::move(options));
}

LinuxCncDriver::~LinuxCncDriver() {
    close();
    body_->remove_program();
}

DriverStatus LinuxCncDriver::status() const {
    const std::scoped_lock lock(body_->mutex);
    return body_->session.status();
}

Capabilities LinuxCncDriver::capabilities() const {
    using kinematics::AxisKind;
    Capabilities able;
    able.plans = able.overrides = able.jog = able.home = able.command = true;
    able.jog_axes = "XYZ";
    able.dialect = gcode::Dialect::linuxcnc;
    for (const char letter : body_->options.axes) {
        able.axes.push_back({letter, letter >= 'X' ? AxisKind::linear : AxisKind::rotary});
    }
    return able;
}

void LinuxCncDriver::connect() {
    if (status().state != DriverState::disconnected) {
        return;
    }
    body_->greet();
    const DriverStatus now = status();
    if (now.state == DriverState::alarm && now.message.find("linuxcncrsh") != std::string::npos) {
        body_->shut();
        throw Error(body_->link->name() + ": " + now.message, {}, "does LinuxCNC run with linuxcncrsh?");
    }
}

void LinuxCncDriver::start(Work work) {
    expects(work.listing != nullptr, "LinuxCNC is given a program's text");
    const linuxcnc::ProgramFile file = linuxcnc::program_file(*work.listing, {}, ++body_->programs);
    body_->remove_program();
    body_->program_file = std::filesystem::absolute(body_->options.program_folder) /
                          fmt::format("millwright-{}-{}.ngc", ::getpid(), body_->programs);
    write_file(body_->program_file, file.text);
    body_->with_session([&](ShellSession& now, double time) {
        now.start(*work.listing, file, body_->program_file.string(), time);
    });
}

void LinuxCncDriver::hold() {
    body_->with_session([](ShellSession& now, double) { now.hold(); });
}

void LinuxCncDriver::resume() {
    body_->with_session([](ShellSession& now, double) { now.resume(); });
}

void LinuxCncDriver::stop() {
    body_->with_session([](ShellSession& now, double time) { now.stop(time); });
}

void LinuxCncDriver::emergency_stop() {
    body_->with_session([](ShellSession& now, double) { now.emergency_stop(); });
}

void LinuxCncDriver::reset() {
    bool lost = false;
    {
        const std::scoped_lock lock(body_->mutex);
        lost = body_->session.link_lost();
    }
    if (lost) {
        body_->shut();
        body_->greet();
    }
    body_->with_session([](ShellSession& now, double time) { now.reset(time); });
    body_->wait_until([](const ShellSession& now) { return now.greeted(); });
}

void LinuxCncDriver::close() noexcept {
    try {
        stop();
        body_->wait_until(
            [](const ShellSession& now) { return now.status().state != DriverState::stopping; });
        body_->shut();
    } catch (const std::exception&) {
        body_->thread = {};
        body_->link->close();
    }
}

void LinuxCncDriver::set_overrides(const Overrides& wanted) {
    body_->with_session([&](ShellSession& now, double) { now.set_overrides(wanted); });
}

void LinuxCncDriver::jog(const Jog& jog) {
    body_->with_session([&](ShellSession& now, double time) { now.jog(jog, time); });
}

void LinuxCncDriver::stop_jog() {
    body_->with_session([](ShellSession& now, double time) { now.stop_jog(time); });
}

void LinuxCncDriver::home() {
    body_->with_session([](ShellSession& now, double time) { now.home(time); });
}

int LinuxCncDriver::command(const std::string& lines) {
    return body_->with_session([&](ShellSession& now, double time) { return now.command(lines, time); });
}

Console* LinuxCncDriver::console() {
    return &body_->console;
}

} // namespace millwright::machine
