#include "app/question.h"

#include "core/base/error.h"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <cstdio>

namespace millwright::app {

std::string question(const std::string& text, const std::stop_token& stop) {
    fmt::print("{}", text);
    std::fflush(stdout);
    std::string answer;
    while (true) {
        if (stop.stop_requested()) {
            fmt::print("\n");
            throw Cancelled();
        }
        constexpr int glance_ms = 50;
        pollfd input{STDIN_FILENO, POLLIN, 0};
        if (::poll(&input, 1, glance_ms) <= 0) {
            continue;
        }
        char byte = 0; // one at a time: what follows the line belongs to the next question
        if (::read(STDIN_FILENO, &byte, 1) != 1 || byte == '\n') {
            return answer;
        }
        answer += byte;
    }
}

} // namespace millwright::app
