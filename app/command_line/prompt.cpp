#include "app/command_line/prompt.h"

#include "app/command_line/output_streams.h"
#include "core/base/error.h"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <system_error>

namespace millwright::app {

std::string prompt(const std::string& text, const std::stop_token& stop) {
    fmt::print("{}", printable(text));
    if (const int failure = output_failure(); failure != 0) {
        throw Error("cannot ask for input: standard output could not be written: " +
                    std::error_code(failure, std::generic_category()).message());
    }
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
        constexpr std::size_t longest = 1000; // bytes; no answer is
        if (::read(STDIN_FILENO, &byte, 1) != 1 || byte == '\n' || answer.size() == longest) {
            return answer;
        }
        answer += byte;
    }
}

} // namespace millwright::app
