#include "core/emulators/linuxcnc/linuxcnc_emulator.h"

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/emulators/linuxcnc/internal/task.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <utility>

namespace millwright::emulators {

namespace {

using internal::LinuxCncTask;
using internal::TaskMode;
using kinematics::AxisPositions;

constexpr std::string_view position_letters = "XYZABC"; // in the order of ABS_ACT_POS

std::string upper(std::string_view text) {
    std::string result;
    for (const char c : text) {
        result += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    }
    return result;
}

std::string_view take_word(std::string_view& text) {
    const std::size_t begin = std::min(text.find_first_not_of(' '), text.size());
    text.remove_prefix(begin);
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(word.size());
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    return word;
}

std::optional<double> number_of_word(std::string_view word) {
    double value = 0.0;
    const auto read = std::from_chars(word.data(), word.data() + word.size(), value);
    const bool whole = read.ec == std::errc{} && read.ptr == word.data() + word.size();
    return whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::optional<bool> on_or_off(std::string_view word) {
    const std::string name = upper(word);
    return name == "ON" ? std::optional(true) : name == "OFF" ? std::optional(false) : std::nullopt;
}

} // namespace

/// The conversation; what the commands do is the task's.
class LinuxCncEmulator::Body {
public:
    explicit Body(LinuxCncEmulatorOptions options)
        : options_(std::move(options)), task_(std::make_unique<LinuxCncTask>(options_.model)) {
        if (options_.homed) {
            task_->set_estop(false);
            task_->set_power(true);
            task_->home();
            constexpr double long_enough = 1.0; // s; it stands at its zero already
            task_->advance(long_enough);
        }
    }

    void receive(std::string_view bytes) {
        constexpr std::size_t longest = 1024;
        for (const char byte : bytes) {
            if (byte != '\n' && byte != '\r') {
                input_ += input_.size() < longest ? std::string(1, byte) : "";
            } else if (!input_.empty()) {
                const std::string line = std::exchange(input_, {});
                if (echo_) {
                    say(line);
                }
                execute(line);
            }
        }
    }
    std::string take_output() { return std::exchange(output_, {}); }
    void power_cycle() {
        LinuxCncTruth truth = task_->truth();
        task_ = std::make_unique<LinuxCncTask>(options_.model, task_->time(), std::move(truth));
        known_ = enabled_ = verbose_ = false;
        echo_ = true;
        input_.clear();
        output_.clear();
    }

    [[nodiscard]] LinuxCncTask& task() { return *task_; }

private:
    using Setter = std::function<bool(std::string_view)>; ///< false: refused

    LinuxCncEmulatorOptions options_;
    std::unique_ptr<LinuxCncTask> task_;
    std::string input_, output_;
    bool known_ = false, enabled_ = false, verbose_ = false, echo_ = true;

    void say(const std::string& line) { output_ += line + "\r\n"; }

    void execute(std::string_view line) {
        const std::string command = upper(take_word(line));
        if (command == "HELLO") {
            hello(line);
        } else if (command == "GET" && known_) {
            get(line);
        } else if (command == "SET" && known_) {
            set(line);
        }
    }

    void hello(std::string_view words) {
        known_ = take_word(words) == options_.password && !words.empty();
        enabled_ = verbose_ = false;
        say(known_ ? "HELLO ACK EMCNETSVR 1.1" : "HELLO NAK");
    }

    void set(std::string_view words) {
        const std::string subject = upper(take_word(words));
        const bool accepted = set_session(subject, words) || (enabled_ && set_machine(subject, words));
        if (!accepted) {
            say("SET " + subject + " NAK");
        } else if (verbose_) {
            say("SET " + subject + " ACK");
        }
    }

    bool set_session(const std::string& subject, std::string_view words) {
        if (subject == "ENABLE") {
            enabled_ = words == options_.enable_password;
            return enabled_;
        }
        const auto on = on_or_off(words);
        if (subject == "VERBOSE" && on) {
            verbose_ = *on;
        } else if (subject == "ECHO" && on) {
            echo_ = *on;
        } else {
            return subject == "SET_WAIT" && upper(words) == "RECEIVED";
        }
        return true;
    }

    bool set_machine(const std::string& subject, std::string_view words) {
        const std::map<std::string, Setter> setters = {
            {"ESTOP", [this](std::string_view to) { return switched(to, &LinuxCncTask::set_estop); }},
            {"MACHINE", [this](std::string_view to) { return switched(to, &LinuxCncTask::set_power); }},
            {"TELEOP_ENABLE", [](std::string_view to) { return on_or_off(to).has_value(); }},
            {"MODE", [this](std::string_view to) { return set_mode(upper(to)); }},
            {"OPEN", [this](std::string_view to) { return done([&] { task_->open(std::string(to)); }); }},
            {"RUN", [this](std::string_view to) { return to.empty() && done([&] { task_->run(); }); }},
            {"PAUSE", [this](std::string_view) { return done([&] { task_->pause(); }); }},
            {"RESUME", [this](std::string_view) { return done([&] { task_->resume(); }); }},
            {"ABORT", [this](std::string_view) { return done([&] { task_->abort(); }); }},
            {"MDI", [this](std::string_view to) { return done([&] { task_->mdi(std::string(to)); }); }},
            {"HOME", [this](std::string_view to) { return to == "-1" && done([&] { task_->home(); }); }},
            {"JOG_INCR", [this](std::string_view to) { return jog(to); }},
            {"JOG_STOP",
             [this](std::string_view to) { return axis(to) && done([&] { task_->stop_jog(); }); }},
            {"FEED_OVERRIDE", [this](std::string_view to) { return set_feed_override(to); }}};
        const auto found = setters.find(subject);
        return found != setters.end() && found->second(words);
    }

    template <class Act> static bool done(const Act& act) {
        act();
        return true;
    }

    bool switched(std::string_view to, void (LinuxCncTask::*how)(bool)) {
        const auto on = on_or_off(to);
        return on && done([&] { ((*task_).*how)(*on); });
    }

    bool set_mode(const std::string& name) {
        constexpr std::array<std::pair<std::string_view, TaskMode>, 3> modes{
            {{"MANUAL", TaskMode::manual}, {"AUTO", TaskMode::automatic}, {"MDI", TaskMode::mdi}}};
        for (const auto& [known, mode] : modes) {
            if (known == name) {
                task_->set_mode(mode);
                return true;
            }
        }
        return false;
    }

    /// By its letter, as in teleop mode.
    [[nodiscard]] std::optional<int> axis(std::string_view word) const {
        const int index = word.size() == 1 ? task_->model().axis_index(upper(word).front()) : -1;
        return index >= 0 ? std::optional(index) : std::nullopt;
    }

    bool jog(std::string_view words) {
        const auto which = axis(take_word(words));
        const auto speed = number_of_word(take_word(words));
        const auto way = number_of_word(words);
        if (!which || !speed || !way || !(std::abs(*speed) > 0.0) || !(*way > 0.0)) {
            return false;
        }
        task_->jog(*which, *speed, *way);
        return true;
    }

    bool set_feed_override(std::string_view words) {
        constexpr double most = 200.0;
        const auto percent = number_of_word(words);
        const bool usable = percent && *percent >= 0.0 && *percent <= most;
        return usable && done([&] { task_->set_feed_override(static_cast<int>(*percent)); });
    }

    void get(std::string_view words) {
        const std::string subject = upper(take_word(words));
        const std::string text = value(subject);
        say(text.empty() ? "GET " + subject + " NAK" : subject + " " + text);
    }

    /// Empty for what there is not.
    std::string value(const std::string& subject) {
        const auto on = [](bool is) { return std::string(is ? "ON" : "OFF"); };
        const drivers::DriverStatus now = task_->machine();
        const std::map<std::string, std::function<std::string()>> values = {
            {"ESTOP", [&] { return on(task_->estop()); }},
            {"MACHINE", [&] { return on(task_->power()); }},
            {"MODE", [&] { return mode_name(); }},
            {"ERROR", [&] { return task_->take_error(); }},
            {"OPERATOR_DISPLAY", [&] { return task_->take_message(); }},
            {"PROGRAM_STATUS", [&] { return task_->program_status(); }},
            {"PROGRAM_LINE", [&] { return std::to_string(task_->program_line()); }},
            {"ABS_ACT_POS", [&] { return six(now.position); }},
            {"REL_ACT_POS", [&] { return six(now.work_position()); }},
            {"JOINT_HOMED", [&] { return homed(); }},
            {"FEED_OVERRIDE", [&] { return std::to_string(task_->feed_override()); }},
            {"PROGRAM_CODES", [&] { return now.modes; }},
            {"MIST", [&] { return on(now.coolant.mist); }},
            {"FLOOD", [&] { return on(now.coolant.flood); }},
            {"TOOL", [&] { return std::to_string(now.tool); }},
            {"USER_LINEAR_UNITS", [] { return std::string("MM"); }}};
        const auto found = values.find(subject);
        return found == values.end() ? std::string() : found->second();
    }

    [[nodiscard]] std::string mode_name() const {
        return task_->mode() == TaskMode::manual ? "MANUAL" : task_->mode() == TaskMode::mdi ? "MDI" : "AUTO";
    }

    [[nodiscard]] std::string homed() const {
        std::string text;
        for (int n = 0; n < task_->model().axis_count(); ++n) {
            text += std::string(n == 0 ? "" : " ") + (task_->homed() ? "YES" : "NO");
        }
        return text;
    }

    [[nodiscard]] std::string six(const AxisPositions& position) const {
        std::string text;
        for (const char letter : position_letters) {
            const int n = task_->model().axis_index(letter);
            const double raw = n >= 0 && n < position.size() ? position[n] : 0.0;
            const bool rotary = position_letters.find(letter) > 2;
            text += (text.empty() ? "" : " ") + fixed(rotary ? to_degrees(raw) : raw, 4);
        }
        return text;
    }
};

LinuxCncEmulator::LinuxCncEmulator(LinuxCncEmulatorOptions options) {
    expects(options.model != nullptr, "an emulated LinuxCNC has a machine");
    for (const char letter : position_letters.substr(0, 3)) {
        expects(options.model->axis_index(letter) >= 0, "a LinuxCNC's machine has X, Y and Z");
    }
    body_ = std::make_unique<Body>(std::move(options));
}

LinuxCncEmulator::~LinuxCncEmulator() = default;

void LinuxCncEmulator::receive(std::string_view bytes) {
    body_->receive(bytes);
}

void LinuxCncEmulator::advance(double seconds) {
    expects(seconds >= 0.0, "time does not run backwards");
    body_->task().advance(seconds);
}

std::string LinuxCncEmulator::take_output() {
    return body_->take_output();
}

bool LinuxCncEmulator::moving() const {
    return body_->task().machine().activity != drivers::Activity::none;
}

void LinuxCncEmulator::raise_alarm() {
    body_->task().set_estop(true);
}

void LinuxCncEmulator::power_cycle() {
    body_->power_cycle();
}

double LinuxCncEmulator::time() const {
    return body_->task().time();
}

AxisPositions LinuxCncEmulator::position() const {
    return body_->task().machine().position;
}

const LinuxCncTruth& LinuxCncEmulator::truth() const {
    return body_->task().truth();
}

void LinuxCncEmulator::abort_at_the_machine() {
    body_->task().abort();
}

} // namespace millwright::emulators
