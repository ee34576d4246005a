#include "app/progress_printer.h"

#include "core/base/text.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace millwright::app {

namespace {

constexpr int bar_width = 30;

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

} // namespace

ProgressPrinter::ProgressPrinter()
    : on_terminal_(::isatty(STDERR_FILENO) == 1), begin_(Clock::now()),
      last_(begin_ - std::chrono::hours(1)) {}

ProgressPrinter::~ProgressPrinter() {
    finish();
}

void ProgressPrinter::show(const Progress::Report& report) {
    const auto now = Clock::now();
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

void ProgressPrinter::draw_bar(const Progress::Report& report, double elapsed) {
    const int done = static_cast<int>(bar_width * std::clamp(report.fraction, 0.0, 1.0));
    std::string line = fmt::format("[{:#<{}}{:.<{}}] {:3} %  {}{}",
                                   "",
                                   done,
                                   "",
                                   bar_width - done,
                                   percent(report.fraction),
                                   report.text,
                                   remaining(report.fraction, elapsed));
    line.resize(std::min(line.size(), static_cast<std::size_t>(terminal_columns() - 1)));
    fmt::print(stderr, "\r\033[K{}", line);
    std::fflush(stderr);
    drawn_ = true;
}

void ProgressPrinter::print_line(const Progress::Report& report) {
    const int tenths = percent(report.fraction) / 10;
    if (report.text == text_ && tenths == tenths_) {
        return;
    }
    text_ = report.text;
    tenths_ = tenths;
    fmt::print(stderr, "{:3} %  {}\n", percent(report.fraction), report.text);
    std::fflush(stderr);
}

void ProgressPrinter::finish() {
    if (drawn_) {
        fmt::print(stderr, "\r\033[K");
        std::fflush(stderr);
        drawn_ = false;
    }
}

} // namespace millwright::app
