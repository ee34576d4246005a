#include "core/drivers/linuxcnc/internal/shell_session.h"

#include "core/links/link.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace millwright::drivers::linuxcnc {

namespace {

std::string upper(std::string text) {
    for (char& c : text) {
        c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    }
    return text;
}

} // namespace

void ShellSession::send(const std::string& request, std::string subject) {
    output_ += request + "\r\n";
    outstanding_.push_back({request, std::move(subject)});
}

void ShellSession::set(const std::string& words) {
    send("set " + words, upper(words.substr(0, words.find(' '))));
}

void ShellSession::get(const std::string& subject) {
    send("get " + subject, upper(subject));
}

void ShellSession::opened(double now) {
    *this = ShellSession(settings_);
    stage_ = Stage::greeting;
    last_heard_ = since_ = now;
    host_stall_.begin(now);
    send("hello " + settings_.password + " millwright 1.0", "HELLO");
    output_ += "set echo off\r\n"; // answered by its echo, or not at all
    set("verbose on");
    set("enable " + settings_.enable_password);
    set("set_wait received");
    get("user_linear_units");
}

void ShellSession::closed() {
    stage_ = Stage::closed;
    output_.clear();
}

void ShellSession::lost(const std::string& why) {
    if (stage_ == Stage::closed || link_lost_) {
        return;
    }
    link_lost_ = true;
    const std::string_view then =
        stage_ == Stage::running || stage_ == Stage::foreign
            ? "; LinuxCNC continues the program: inspect the machine"
        : stage_ == Stage::stopping
            ? "; it is not known whether LinuxCNC received the stop command: inspect the machine"
            : "";
    finish(Stage::alarm, links::loss_sentence(why) + std::string(then));
    output_.clear();
}

void ShellSession::receive(std::string_view bytes, double now) {
    constexpr std::size_t longest = 4096;
    for (const char byte : bytes) {
        if (byte != '\n' && byte != '\r') {
            input_ += input_.size() < longest ? std::string(1, byte) : "";
        } else if (!input_.empty() && stage_ != Stage::closed && !link_lost_) {
            handle(read_reply(std::exchange(input_, {})), now);
        }
    }
}

void ShellSession::handle(const Reply& reply, double now) {
    if (reply.kind == Reply::Kind::other || outstanding_.empty() ||
        outstanding_.front().subject != reply.subject) {
        return; // an echo
    }
    const Request request = outstanding_.front();
    outstanding_.pop_front();
    last_heard_ = now; // an echo is no answer: a LinuxCNC without a session echoes too
    if (reply.kind == Reply::Kind::refused) {
        refused(request.text, now);
        return;
    }
    if (reply.kind == Reply::Kind::value) {
        values_[reply.subject] = reply.text;
        if (reply.subject == "ERROR" && reply.text != "OK") {
            error_ += (error_.empty() ? "" : "; ") + reply.text;
        }
        if (reply.subject == "OPERATOR_DISPLAY" && run_ && !run_->file.end_mark.empty() &&
            reply.text.find(run_->file.end_mark) != std::string::npos) {
            run_->marked = true;
        }
    }
    if (outstanding_.empty() && in_round_) {
        in_round_ = false;
        round_done(now);
    }
}

void ShellSession::refused(const std::string& request, double now) {
    if (stage_ == Stage::greeting) {
        finish(Stage::alarm,
               request.starts_with("hello") || request.starts_with("set enable")
                   ? "linuxcncrsh refuses the password"
                   : "linuxcncrsh refuses '" + request + "'");
        return;
    }
    fail("LinuxCNC refuses '" + request + "'", now);
}

/// It may still hear what it does not answer, so a motion is ordered to end.
void ShellSession::fall_silent() {
    const bool moves = active() || stage_ == Stage::stopping;
    if (moves) {
        set("abort");
    }
    finish(Stage::alarm,
           stage_ == Stage::greeting ? "no linuxcncrsh answers at this port"
           : moves ? "LinuxCNC no longer answers; a stop was sent, but it is not known whether it stopped: "
                     "inspect the machine"
                   : "LinuxCNC no longer answers: inspect the machine");
    outstanding_.clear();
}

void ShellSession::tick(double now) {
    if (stage_ == Stage::closed || link_lost_) {
        return;
    }
    last_heard_ = std::min(now, last_heard_ + host_stall_.taken(now));
    if (now - last_heard_ > settings_.patience && !outstanding_.empty()) {
        fall_silent();
        in_round_ = false;
    }
    if (jog_until_ && now > *jog_until_) {
        stop_jog(now);
    }
    if (outstanding_.empty() && now >= next_round_) {
        ask(now);
    }
    pump_jog();
}

void ShellSession::ask(double now) {
    const bool hurry = stage_ == Stage::jogging;
    next_round_ = now + (hurry ? 0.25 : 1.0) * settings_.poll_interval;
    in_round_ = true;
    error_.clear();
    for (const char* subject : {"estop",
                                "machine",
                                "mode",
                                "error",
                                "operator_display",
                                "program_status",
                                "program_line",
                                "abs_act_pos",
                                "rel_act_pos",
                                "joint_homed",
                                "feed_override",
                                "program_codes",
                                "mist",
                                "flood",
                                "tool"}) {
        get(subject);
    }
}

const std::string& ShellSession::value(const std::string& subject) const {
    static const std::string nothing;
    const auto found = values_.find(subject);
    return found == values_.end() ? nothing : found->second;
}

bool ShellSession::idle_now() const {
    return value("PROGRAM_STATUS") == "IDLE";
}

} // namespace millwright::drivers::linuxcnc
