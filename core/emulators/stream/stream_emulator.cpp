#include "core/emulators/stream/stream_emulator.h"

#include "core/base/counted.h"
#include "core/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

namespace millwright::emulators {

namespace {

constexpr std::string_view heading_words = "# millwright-stream 1 period_s ";
constexpr std::size_t longest_line = 256;

std::vector<std::string_view> words_between_spaces(std::string_view line) {
    std::vector<std::string_view> words;
    while (!line.empty()) {
        const std::size_t end = std::min(line.find(' '), line.size());
        words.push_back(line.substr(0, end));
        line.remove_prefix(std::min(end + 1, line.size()));
    }
    return words;
}

std::optional<double> number_in_record(std::string_view word) {
    double value = 0.0;
    const auto read = std::from_chars(word.data(), word.data() + word.size(), value);
    const bool whole = read.ec == std::errc{} && read.ptr == word.data() + word.size();
    return whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

} // namespace

void StreamEmulator::receive(std::string_view bytes) {
    for (const char byte : bytes) {
        if (byte == '\n') {
            const std::string line = std::exchange(input_, {});
            if (std::exchange(too_long_, false)) {
                bad(line, "the line is too long");
            } else {
                take(line);
            }
        } else if (input_.size() < longest_line) {
            input_ += byte;
        } else {
            too_long_ = true;
        }
    }
}

void StreamEmulator::bad(std::string_view line, std::string_view why) {
    ++truth_.bad_lines;
    if (truth_.first_fault.empty()) {
        truth_.first_fault = fmt::format("{}: \"{}\"", why, line.substr(0, 40));
    }
}

void StreamEmulator::take(std::string_view line) {
    if (line.starts_with('#')) {
        take_heading(line);
        return;
    }
    if (!(period_ > 0.0)) {
        bad(line, "a sample arrived before a heading");
        return;
    }
    std::vector<double> sample;
    for (const std::string_view word : words_between_spaces(line)) {
        const auto value = number_in_record(word);
        if (!value) {
            bad(line, "this is not a number");
            return;
        }
        sample.push_back(*value);
    }
    if (sample.size() != axes_.size()) {
        bad(line,
            fmt::format(
                "{} for {}", counted(sample.size(), "number"), counted(axes_.size(), "axis", "axes")));
        return;
    }
    if (due_.empty()) {
        next_ = std::max(next_, time_); // it stands: this sample begins a new motion
    }
    due_.push_back(std::move(sample));
}

void StreamEmulator::take_heading(std::string_view line) {
    due_.clear();
    period_ = 0.0;
    axes_.clear();
    const bool known = line.starts_with(heading_words);
    const auto words = words_between_spaces(known ? line.substr(heading_words.size()) : std::string_view());
    const auto period = words.empty() ? std::nullopt : number_in_record(words.front());
    if (!period || !(*period > 0.0) || words.size() < 3 || words.size() % 2 == 0) {
        bad(line, "this is not a coordinate stream heading");
        return;
    }
    for (std::size_t n = 1; n < words.size(); n += 2) {
        if (words[n].size() != 1 || (words[n + 1] != "mm" && words[n + 1] != "deg")) {
            bad(line, "this is not an axis with its unit");
            axes_.clear();
            return;
        }
        axes_.emplace_back(words[n]);
    }
    period_ = *period;
    position_.clear();
    truth_.greatest_speed.assign(axes_.size(), 0.0);
    ++truth_.headings;
}

void StreamEmulator::advance(double seconds) {
    expects(seconds >= 0.0, "time does not run backwards");
    const double end = time_ + seconds;
    while (!due_.empty() && next_ <= end) {
        time_ = std::max(time_, next_);
        next_ += period_;
        go_to(std::move(due_.front()));
        due_.pop_front();
    }
    time_ = end;
}

void StreamEmulator::go_to(std::vector<double> sample) {
    ++truth_.samples;
    if (position_.empty()) { // the first sample sets its position
        position_ = std::move(sample);
        return;
    }
    for (std::size_t n = 0; n < sample.size(); ++n) {
        const double speed = std::abs(sample[n] - position_[n]) / period_;
        truth_.greatest_speed[n] = std::max(truth_.greatest_speed[n], speed);
        truth_.last_motion = speed > 0.0 ? time_ : truth_.last_motion;
    }
    position_ = std::move(sample);
}

void StreamEmulator::raise_alarm() {
    due_.clear();
    period_ = 0.0;
}

void StreamEmulator::power_cycle() {
    raise_alarm();
    axes_.clear();
    position_.clear();
    input_.clear();
}

} // namespace millwright::emulators
