#include "core/pmac/driver/internal/guarded_line.h"

#include "core/base/error.h"

#include <algorithm>
#include <charconv>
#include <utility>

namespace millwright::pmac::internal {

namespace {

constexpr char report_sum = '\x0E', forget_all = '\x18', cr = '\r', ack = '\x06', bell = '\a',
               line_feed = '\n';
constexpr double quiet = 0.05;       // s after which nothing more comes
constexpr double longest_gap = 0.25; // s within an answer
constexpr std::size_t longest_answer = 300;

int error_number(std::string_view text) {
    const std::size_t at = text.find("ERR");
    int number = 0;
    if (at != std::string_view::npos) {
        std::from_chars(text.data() + at + 3, text.data() + text.size(), number);
    }
    return number;
}

} // namespace

char checksum(std::string_view text) {
    unsigned sum = 0;
    for (const char c : text) {
        sum += static_cast<unsigned char>(c);
    }
    return static_cast<char>(sum & 0xFFU);
}

void GuardedLine::send(std::string line, bool repeats, double now) {
    expects(idle(), "one line after the other");
    line_ = std::move(line);
    repeats_ = repeats;
    reply_ = {};
    begun_ = now;
    put_line(now);
}

void GuardedLine::put_line(double now) {
    input_.clear();
    output_ += line_ + report_sum;
    step_ = Step::summing;
    since_ = last_byte_ = now;
}

void GuardedLine::again(double now) {
    output_ += forget_all;
    if (!repeats_) {
        end(Outcome::unsent);
        return;
    }
    step_ = Step::clearing;
    since_ = last_byte_ = now;
}

void GuardedLine::end(Outcome outcome) {
    reply_.outcome = outcome;
    step_ = Step::ended;
}

void GuardedLine::forget() {
    step_ = Step::idle;
    input_.clear();
    reply_ = {};
}

std::string GuardedLine::take_output() {
    return std::exchange(output_, {});
}

void GuardedLine::receive(std::string_view bytes, double now) {
    if (bytes.empty()) {
        return;
    }
    last_byte_ = now;
    switch (step_) {
    case Step::summing:
        if (bytes.size() == 1 && bytes.front() == checksum(line_)) {
            output_ += cr;
            step_ = Step::waiting;
            since_ = now;
        } else {
            reply_.heard = true;
            again(now);
        }
        break;
    case Step::waiting:
    case Step::refusing:
        reply_.heard = true;
        input_ += bytes;
        read_answer();
        break;
    default: // late bytes of what is over
        break;
    }
}

void GuardedLine::read_answer() {
    while (step_ == Step::waiting && !input_.empty() && input_.front() != bell) {
        if (input_.front() == line_feed) { // the hand-shake of a card that was reset: no time is to be lost
            end(Outcome::lost);
        } else if (input_.front() == ack) {
            if (input_.size() < 2) {
                return;
            }
            end(input_[1] == checksum(line_) && input_.size() == 2 ? Outcome::answered : Outcome::lost);
        } else {
            const std::size_t length = input_.find(cr);
            if (length == std::string::npos || length + 1 == input_.size()) {
                if (input_.size() > longest_answer) {
                    end(Outcome::lost);
                }
                return;
            }
            if (input_[length + 1] != checksum(std::string_view(input_).substr(0, length + 1))) {
                end(Outcome::lost);
                return;
            }
            reply_.lines.push_back(input_.substr(0, length));
            input_.erase(0, length + 2);
        }
    }
    const bool rings = step_ == Step::waiting && !input_.empty(); // its bell stands in front
    if (rings || step_ == Step::refusing) {
        step_ = Step::refusing;
        read_refusal();
    }
}

/// Ends it as soon as the error has come whole: a guard that is armed takes a longer silence for a lost link.
void GuardedLine::read_refusal() {
    const std::string_view error = std::string_view(input_).substr(1); // behind the bell
    const std::size_t length = error.find(cr);
    if (length != std::string_view::npos && error.size() == length + 2 && error.starts_with("ERR") &&
        error.back() == checksum(error.substr(0, length + 1))) {
        refuse();
    }
}

void GuardedLine::refuse() {
    reply_.error = error_number(input_);
    output_ += forget_all;
    end(Outcome::refused);
}

void GuardedLine::leave_out(double seconds, double now) {
    for (double* const time : {&begun_, &since_, &last_byte_}) {
        *time = std::min(now, *time + seconds);
    }
}

GuardedLine::Reply GuardedLine::poll(double now) {
    constexpr double share = 0.25; // of the patience, for one try
    const bool guarding = step_ == Step::summing || step_ == Step::clearing;
    if (guarding && now - begun_ > patience_) {
        output_ += forget_all;
        end(Outcome::lost);
    } else if (step_ == Step::summing && now - since_ > share * patience_) {
        again(now);
    } else if (step_ == Step::clearing && now - last_byte_ > quiet) {
        put_line(now);
    } else if (step_ == Step::refusing && now - last_byte_ > quiet) {
        refuse();
    } else if (step_ == Step::waiting &&
               (now - since_ > patience_ || (!input_.empty() && now - last_byte_ > longest_gap))) {
        end(Outcome::lost);
    }
    if (step_ != Step::ended) {
        return {};
    }
    step_ = Step::idle;
    return std::exchange(reply_, {});
}

} // namespace millwright::pmac::internal
