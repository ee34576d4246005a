#include "core/pmac/driver/internal/pmac_session.h"

#include "core/base/error.h"
#include "core/links/link.h"
#include "core/pmac/driver/internal/card_numbers.h"
#include "core/pmac/driver/internal/command_kind.h"
#include "core/pmac/driver/internal/watchdog.h"
#include "core/pmac/driver/pmac_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace millwright::pmac::internal {

namespace {

constexpr double poll_interval = 0.02;    // s
constexpr double reading_interval = 0.08; // s: ten times per second with what comes between
constexpr int most_tries = 3;             // of a line that moves, each after a look at the card
constexpr char repeats_or_not = '\x14';   // ^T
constexpr double greeting_pause = 0.1;    // s: an answer in whatever mode the card is in

bool starts_with_word(const std::string& line, std::string_view word) {
    std::string tight;
    for (const char c : line) {
        tight += c == ' ' ? "" : std::string(1, c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c);
    }
    return tight.starts_with(word);
}

} // namespace

void PmacSession::opened(double now) {
    stage_ = Stage::greeting;
    link_ = Link::silent;
    message_.clear();
    queue_.clear();
    sent_.reset();
    talk_.forget();
    greet_step_ = 0;
    greeting_heard_.clear();
    greet_at_ = opened_at_ = now;
    host_stall_.begin(now);
    exchange_ = {};
    homing_ = {};
    watchdog_ = {};
    power_ = {};
    polled_ = was_home_ = false;
    guard_.forget();
    leaving_.reset();
    own_jog_speeds_.assign(motors_.size(), std::nullopt);
    addresses_ = fmt::format("#1&{}", settings_.system);
    answer_ = {};
    typed_.clear();
}

void PmacSession::lost(const std::string& why) {
    const bool spoke = stage_ != Stage::greeting; // else nothing was sent that moves a motor
    finish(Stage::alarm, links::loss_sentence(why) + (spoke ? "; the card stops its motors on its own" : ""));
    link_ = Link::lost;
    unseen_ = true;
    if (leaving_) {
        farewell_ = "the connection was lost before the card reported that its motors are disabled";
        leaving_.reset();
    }
    talk_.forget();
    queue_.clear();
    sent_.reset();
    output_.clear();
}

void PmacSession::closed() {
    stage_ = Stage::closed;
    link_ = Link::silent;
    queue_.clear();
    sent_.reset();
    talk_.forget();
    output_.clear();
}

std::string PmacSession::take_output() {
    output_ += talk_.take_output();
    return ControllerSession::take_output();
}

std::vector<drivers::ConsoleLine> PmacSession::take_console() {
    return std::exchange(told_, {});
}

void PmacSession::tell(bool sent, drivers::ConsoleKind kind, std::string text) {
    told_.push_back({.sent = sent, .kind = kind, .text = std::move(text)});
}

/// Whether a request comes from the driver alone, so often that a person does not want to read it.
bool PmacSession::is_ours(Kind kind) {
    return kind == Kind::poll || kind == Kind::reading || kind == Kind::rating || kind == Kind::address ||
           kind == Kind::watch || kind == Kind::jog_speeds || kind == Kind::greet ||
           kind == Kind::definitions;
}

/// What moves nothing, and lines of a buffer, which a card that was reset refuses.
bool PmacSession::may_repeat(Kind kind) const {
    return exchange_.buffer_open || stage_ == Stage::greeting ||
           !(kind == Kind::step || kind == Kind::run || kind == Kind::command);
}

void PmacSession::receive(std::string_view bytes, double now) {
    link_ = link_ == Link::silent && !bytes.empty() ? Link::heard : link_;
    if (stage_ == Stage::greeting && talk_.idle()) {
        greeting_heard_ += bytes;
    }
    talk_.receive(bytes, now);
}

/// For a person, to whom the driver's own questions say nothing.
std::string PmacSession::asked(const Request& request) {
    switch (request.kind) {
    case Kind::poll:
        return "the query for motor status";
    case Kind::rating:
    case Kind::reading:
    case Kind::jog_speeds:
        return "the query for motor values";
    case Kind::address:
        return "the query for the addressed motor";
    case Kind::watch:
        return "a setting of Millwright's own";
    case Kind::step:
        return request.line.starts_with('I') ? "a jog's speed" : "'" + request.line + "'";
    default:
        return "'" + request.line + "'";
    }
}

/// In whatever mode the card is, brings it into ours; then asks who it is.
void PmacSession::greet(double now) {
    constexpr std::array<std::string_view, 5> steps{"\x18", "CLOSE\r", "I3=2\r", "I6=1\r", "I4=1\r"};
    if (now < greet_at_) {
        return;
    }
    greet_at_ = now + greeting_pause;
    constexpr std::size_t behind_close = 2;
    if (greet_step_ == behind_close && greeting_heard_.find("CLOSE\r") != std::string::npos) {
        output_ += repeats_or_not; // else each line would be taken for its answer
        tell(true, drivers::ConsoleKind::realtime, "^T: the card echoed what it was sent; echo is now off");
    }
    if (greet_step_ < steps.size()) {
        output_ += steps[greet_step_++];
    } else if (greet_step_ == steps.size()) {
        ++greet_step_;
        ask("TYPE", Kind::greet);
        ask("I9=0", Kind::greet);
        ask("I10", Kind::greet);
        ask_ratings();
        ask(poll_line(), Kind::poll);
    }
}

/// Its lines, before what else is to be asked.
void PmacSession::make_guard(const std::vector<std::string>& servo_time) {
    const auto number = servo_time.size() == 1 ? card_number(servo_time.front()) : std::nullopt;
    try {
        std::vector<std::string> lines = watchdog_lines(settings_, number.value_or(0.0));
        for (auto line = lines.rbegin(); line != lines.rend(); ++line) {
            queue_.push_front({std::move(*line), Kind::greet, 0});
        }
    } catch (const Error& error) {
        queue_.clear();
        finish(Stage::alarm, error.what());
    }
}

void PmacSession::tick(double now) {
    if (stage_ == Stage::closed || link_lost()) {
        return;
    }
    if (stage_ == Stage::greeting) {
        greet(now);
    }
    talk_.leave_out(host_stall_.taken(now), now);
    if (const GuardedLine::Reply reply = talk_.poll(now); reply.outcome != GuardedLine::Outcome::none) {
        handle(reply, now);
    }
    if (jogging_.until && now > *jogging_.until) {
        stop_jog(now);
    }
    watch_time(now);
    part(now);
    if (!talk_.idle()) {
        return;
    }
    ask_something(now);
}

/// A line that is too slow, or motors that do not brake, must not be waited for for ever.
void PmacSession::watch_time(double now) {
    constexpr double braking = 10.0; // s
    const double greeting = 10.0 + 3.0 * settings_.patience;
    if (stage_ == Stage::stopping && !braking_.by) {
        braking_.by = now + braking;
    } else if (stage_ == Stage::stopping && now > *braking_.by) {
        fail("the motors do not come to rest, or the connection is too slow to report it");
    } else if (stage_ == Stage::greeting && now > opened_at_ + greeting) {
        queue_.clear();
        finish(Stage::alarm, fmt::format("the answers take too long: the greeting took {:.0f} s", greeting));
    }
}

void PmacSession::ask_something(double now) {
    // A command and the question for its addresses belong together; else the report comes first, but not
    // twice where the line is so slow that the next one is due when it comes.
    const bool turn = queue_.empty() || (queue_.front().kind == Kind::command && !exchange_.asked_poll);
    if (exchange_.look_first && polled_ && !exchange_.buffer_open) {
        exchange_.look_first = false;
        next_poll_ = now;
        queue_.push_front({poll_line(), Kind::poll, 0});
    }
    const bool may_poll = turn && polled_ && !exchange_.buffer_open && stage_ != Stage::greeting;
    if (may_poll && now >= next_poll_) {
        sent_ = Request{poll_line(), Kind::poll, 0};
        next_poll_ = now + poll_interval;
    } else if (std::string line = readings_.reading_line();
               may_poll && queue_.empty() && now >= next_reading_ && !line.empty()) {
        sent_ = Request{sign_of_life + std::move(line), Kind::reading, 0};
        next_reading_ = now + reading_interval;
    } else if (!queue_.empty()) {
        sent_ = std::move(queue_.front());
        queue_.pop_front();
    } else {
        return;
    }
    exchange_.asked_poll = sent_->kind == Kind::poll;
    const bool addressed = sent_->kind == Kind::command && !exchange_.buffer_open;
    exchange_.buffer_open = exchange_.buffer_open || starts_with_word(sent_->line, "OPEN");
    tell(true, is_ours(sent_->kind) ? drivers::ConsoleKind::query : drivers::ConsoleKind::line, sent_->line);
    const bool lively = shows_life(*sent_);
    // A number behind the addresses would be read as a part of the last one.
    talk_.send(addressed ? sign_of_life + addresses_ + (sets_p0(sent_->line) ? "P0=" : "") + sent_->line
               : lively  ? std::string(sign_of_life) + " " + sent_->line
                         : sent_->line,
               may_repeat(sent_->kind),
               now);
}

/// Whether a line gets a sign of life of its own: as long as the guard is armed every line does that has
/// nothing to do with a buffer. Reports come only behind what is queued, and each word may be on its way for
/// long. An & behind it would be an operator of its expression.
bool PmacSession::shows_life(const Request& request) const {
    const bool jogs_on = request.kind == Kind::step && stage_ == Stage::jogging;
    const std::string& line = request.line;
    const bool of_buffers =
        exchange_.buffer_open || starts_with_word(line, "OPEN") || starts_with_word(line, "CLOSE");
    return (jogs_on || (watchdog_.armed && stage_ != Stage::alarm)) && !of_buffers &&
           !line.starts_with('&') && !line.starts_with(sign_of_life);
}

void PmacSession::handle(const GuardedLine::Reply& reply, double now) {
    if (!sent_) {
        return;
    }
    const Request request = *std::exchange(sent_, std::nullopt);
    switch (reply.outcome) {
    case GuardedLine::Outcome::answered:
        for (const std::string& line : reply.lines) {
            tell(false,
                 is_ours(request.kind) ? drivers::ConsoleKind::report : drivers::ConsoleKind::answer,
                 line);
        }
        answered(request, reply.lines, now);
        break;
    case GuardedLine::Outcome::refused:
        refused(request, reply.error);
        break;
    case GuardedLine::Outcome::unsent:
        if (request.tries < most_tries) {
            queue_.push_front(request);
            ++queue_.front().tries;
            exchange_.look_first = true;
            break;
        }
        [[fallthrough]];
    default:
        if (stage_ == Stage::greeting) {
            queue_.clear();
            finish(Stage::alarm,
                   link_ == Link::heard ? "the device that answers is not a PMAC" : "no PMAC answers");
        } else if (request.kind == Kind::command && request.line.starts_with("$$$")) {
            fail("the card was reset: its saved settings are active, and it does not know the position of "
                 "the arm");
        } else {
            unseen_ = true;
            fail(reply.heard ? fmt::format("the card answers {} in an unexpected format: check whether it "
                                           "was reset or the connection is disturbed",
                                           asked(request))
                             : fmt::format("the card did not answer {}", asked(request)));
        }
    }
}

void PmacSession::answered(const Request& request, const std::vector<std::string>& lines, double now) {
    if (starts_with_word(request.line, "CLOSE")) {
        exchange_.buffer_open = false;
    }
    power_.plcs_run = power_.plcs_run && request.line != disable_plcs;
    switch (request.kind) {
    case Kind::poll:
        read_poll(lines, now);
        break;
    case Kind::rating:
        readings_.read_rating(request.axis, lines);
        break;
    case Kind::reading:
        readings_.read(lines);
        read_at_ = now;
        break;
    case Kind::jog_speeds:
        slow_down(lines);
        break;
    case Kind::greet:
        if (request.line == "TYPE" && (lines.size() != 1 || !lines.front().starts_with("PMAC"))) {
            queue_.clear();
            finish(Stage::alarm, "the device is not a PMAC");
        } else if (request.line == "I10") {
            make_guard(lines);
        }
        break;
    case Kind::command:
        for (const std::string& line : lines) {
            answer_.add_line(line);
        }
        if (exchange_.buffer_open) {
            next_command();
        } else {
            ask("#&", Kind::address);
        }
        break;
    case Kind::address:
        if (lines.size() == 2) {
            addresses_ = "#" + lines[0] + "&" + lines[1];
        }
        next_command();
        break;
    case Kind::definitions:
        explain_open_loop(run_refusal_ + loop_advice(lines));
        break;
    case Kind::watch:
        watchdog_.mark_is_ours = watchdog_.mark_is_ours || request.line == arm_watchdog;
        break;
    case Kind::run:
        stage_ = stage_ == Stage::loading ? Stage::running : stage_;
        break;
    default:
        break;
    }
}

void PmacSession::refused_command(const Request& request, bool loop_is_open, const std::string& why) {
    const bool opens = starts_with_word(request.line, "OPEN");
    const std::string lacks =
        exchange_.buffer_open && !opens
            ? fmt::format("; the program of '{}' is stored {} this line and is incomplete",
                          command_.opened_by,
                          command_.goes_on ? "without" : "only up to")
            : "";
    if (command_.goes_on) {
        answer_.add_line(why + lacks);
        command_.refused = true;
        if (opens) {
            skip_buffer();
        }
        next_command();
        return;
    }
    command_.lines.clear();
    if (loop_is_open) {
        if (exchange_.buffer_open) {
            ask("CLOSE");
        }
        ask_whose_loop_is_open(why);
        return;
    }
    answer_.add_line(why + lacks);
    if (exchange_.buffer_open) {
        ask("CLOSE");
    }
    finish_command(drivers::CommandAnswer::State::refused);
}

void PmacSession::refused(const Request& request, int error) {
    if (starts_with_word(request.line, "CLOSE")) {
        exchange_.buffer_open = false;
    }
    constexpr int no_command = 3; // what the card also says of a motor that is switched off
    const bool of_motors = error == no_command && request.line.ends_with("J/");
    tell(false, drivers::ConsoleKind::fault, fmt::format("ERR{:03}, {}", error, pmac_error(error)));
    const std::string why = fmt::format(
        "{} is rejected: ERR{:03}, {}{}",
        asked(request),
        error,
        pmac_error(error),
        of_motors ? "; the card answers so if a motor is not active (Ix00 = 0): load the card's settings"
                  : "");
    if (request.kind == Kind::rating || request.kind == Kind::reading) {
        readings_.give_up();
        return;
    }
    constexpr int loop_is_open = 12;
    if (request.kind == Kind::command) {
        refused_command(request, error == loop_is_open, why);
        return;
    }
    if (request.kind == Kind::step && request.line == "CLOSE") {
        return; // a program that was not written completely has no sound structure
    }
    if (request.kind == Kind::definitions) { // a card that does not tell
        explain_open_loop(run_refusal_);
        return;
    }
    if (stage_ == Stage::greeting && request.kind == Kind::greet) {
        if (request.line != "CLOSE") {
            queue_.clear();
            finish(Stage::alarm, why);
        }
        return;
    }
    if (request.kind == Kind::run && error == loop_is_open && stage_ == Stage::loading) {
        ask_whose_loop_is_open(why);
        return;
    }
    if (request.kind == Kind::program || stage_ == Stage::loading) {
        queue_.clear();
        ask("CLOSE");
        finish(Stage::ready, why);
        return;
    }
    fail(why);
}

void PmacSession::next_command() {
    if (command_.lines.empty()) {
        if (exchange_.buffer_open) {
            ask("CLOSE", Kind::command);
            return;
        }
        finish_command(command_.refused ? drivers::CommandAnswer::State::refused
                                        : drivers::CommandAnswer::State::done);
        return;
    }
    const bool opens = starts_with_word(command_.lines.front(), "OPEN");
    command_.opened_by = opens ? command_.lines.front() : command_.opened_by;
    if (watchdog_.armed && opens) { // no sign of life is heard while a buffer is open
        ask(disarm_watchdog, Kind::watch);
        watchdog_.armed = false;
    } else if (!watchdog_.armed && !exchange_.buffer_open && !opens && stage_ != Stage::alarm &&
               !only_asks(command_.lines.front())) {
        arm(); // what a person types may begin motion
    }
    if (!exchange_.buffer_open && jogs(command_.lines.front()) && !is_step(command_.lines.front())) {
        std::string question;
        for (const PmacAxis& axis : settings_.axes) {
            question += fmt::format("I{}22", axis.motor);
        }
        ask(std::move(question), Kind::jog_speeds);
    }
    ask(command_.lines.front(), Kind::command);
    command_.lines.pop_front();
}

/// A short way of one motor: its speed is the card's.
bool PmacSession::is_step(const std::string& line) const {
    const auto step = step_of(line);
    return step && std::any_of(settings_.axes.begin(), settings_.axes.end(), [&](const PmacAxis& axis) {
               return axis.motor == step->motor &&
                      std::abs(step->counts) <= pmac_step_deg * axis.counts_per_degree;
           });
}

void PmacSession::finish_command(drivers::CommandAnswer::State state) {
    answer_.end(state);
    for (MotorState& motor : motors_) {
        motor.lag_is_old = motor.lag_is_old && !motor.gets_power; // what it tells from here on is of this
        motor.gets_power = false;
    }
    if (stage_ == Stage::commanding) {
        finish(watchdog_.armed ? Stage::moving_by_command : Stage::ready);
        ask_ratings(); // it may have set some
    }
}

/// A sign of life, and everything that is watched.
std::string PmacSession::poll_line() const {
    std::string line = sign_of_life;
    for (const PmacAxis& axis : settings_.axes) {
        line += fmt::format("#{}?P", axis.motor);
    }
    return line + fmt::format("&{}??P1000P1003", settings_.system);
}

void PmacSession::ask_ratings() {
    for (std::size_t n = 0; n < motors_.size(); ++n) {
        queue_.push_back({readings_.rating_line(n), Kind::rating, n});
    }
}

std::optional<std::vector<std::string>> PmacSession::protections_off() const {
    const auto is_rating = [](const Request& request) { return request.kind == Kind::rating; };
    const bool asks =
        (sent_ && is_rating(*sent_)) || std::ranges::any_of(queue_, is_rating) || stage_ == Stage::commanding;
    if (asks) {
        return std::nullopt;
    }
    std::vector<std::string> off = readings_.protections_off();
    if (!guard_.runs()) {
        off.emplace_back(guard_is_off);
    }
    return off;
}

/// From now on the card's watchdog stops the motors when it no longer hears us.
void PmacSession::arm() {
    ask(arm_watchdog, Kind::watch);
    watchdog_.armed = true;
    watchdog_.mark_is_ours = false;
    quiet_polls_ = 0;
}

} // namespace millwright::pmac::internal
