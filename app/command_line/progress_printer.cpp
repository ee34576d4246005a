#include "app/command_line/progress_printer.h"

#include "app/command_line/output_streams.h"
#include "core/base/error.h"
#include "core/base/text.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <utility>

namespace millwright::app {

namespace {

constexpr int widest_bar = 30;

int terminal_columns() {
    winsize size{};
    constexpr int usual = 80;
    return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : usual;
}

/// Time that is left if it goes on like this; nothing before there is something to go by.
std::string remaining(double fraction, double elapsed) {
    constexpr double enough_time = 0.5;
    constexpr double enough_work = 0.02;
    if (fraction < enough_work || elapsed < enough_time) {
        return {};
    }
    return ", " + clock_time(elapsed * (1.0 - fraction) / fraction) + " left";
}

int percent(double fraction) {
    return static_cast<int>(100.0 * std::clamp(fraction, 0.0, 1.0));
}

/// What is being done, without how far it is.
std::string without_digits(std::string text) {
    std::erase_if(text, [](unsigned char c) { return std::isdigit(c) != 0; });
    return text;
}

} // namespace

ProgressPrinter::ProgressPrinter()
    : on_terminal_(::isatty(STDERR_FILENO) == 1), begin_(Clock::now()),
      last_(begin_ - std::chrono::hours(1)) {}

ProgressPrinter::~ProgressPrinter() {
    finish();
}

void ProgressPrinter::show(const Progress::Report& report) {
    const auto now = Clock::now();
    if (!error_takes_text()) {
        return;
    }
    if (on_terminal_) {
        constexpr auto interval = std::chrono::milliseconds(80);
        if (now - last_ >= interval) {
            last_ = now;
            draw_bar(report, std::chrono::duration<double>(now - begin_).count());
        }
        return;
    }
    print_line(report);
}

void ProgressPrinter::say(const std::string& line) {
    if (!error_takes_text()) {
        return;
    }
    finish();
    fmt::print(stderr, "{}\n", printable(line));
    std::fflush(stderr);
}

void ProgressPrinter::pause(bool on) {
    const auto now = Clock::now();
    if (paused_) {
        begin_ += now - std::exchange(*paused_, now); // as if it had not passed
    }
    paused_ = on ? std::optional(now) : std::nullopt;
}

void ProgressPrinter::draw_bar(const Progress::Report& report, double elapsed) {
    const auto columns = static_cast<std::size_t>(std::max(1, terminal_columns() - 1));
    const int width = std::min(widest_bar, static_cast<int>(columns) / 4);
    const int done = static_cast<int>(width * std::clamp(report.fraction, 0.0, 1.0));
    const std::string bar =
        fmt::format("[{:#<{}}{:.<{}}] {:3} %", "", done, "", width - done, percent(report.fraction));
    const std::string left = remaining(report.fraction, elapsed);
    const std::size_t taken = bar.size() + left.size() + 2;
    const std::string text = printable(report.text).substr(0, columns > taken ? columns - taken : 0);
    fmt::print(stderr, "\r\033[K{}", fmt::format("{}{}  {}", bar, left, text).substr(0, columns));
    std::fflush(stderr);
    drawn_ = true;
}

void ProgressPrinter::print_line(const Progress::Report& report) {
    const int tenths = percent(report.fraction) / 10;
    std::string words = without_digits(report.text);
    if (words.empty() || (words == words_ && tenths == tenths_)) {
        return;
    }
    words_ = std::move(words);
    tenths_ = tenths;
    fmt::print(stderr, "{:3} %  {}\n", percent(report.fraction), printable(report.text));
    std::fflush(stderr);
}

void ProgressPrinter::finish() {
    if (drawn_ && error_takes_text()) {
        fmt::print(stderr, "\r\033[K");
        std::fflush(stderr);
        drawn_ = false;
    }
}

} // namespace millwright::app
