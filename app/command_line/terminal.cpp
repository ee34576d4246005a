#include "app/command_line/terminal.h"

#include "core/base/error.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <system_error>

namespace millwright::app {

namespace {

struct OutputSink {
    int handle;
    bool lasting; ///< after a failure nothing follows, so that no output has a hole
    std::atomic<int> failure = 0;
};

OutputSink standard_output{STDOUT_FILENO, true};
OutputSink standard_error{STDERR_FILENO, false};

void wait_until_writable(int handle) {
    pollfd waiting{handle, POLLOUT, 0};
    ::poll(&waiting, 1, -1);
}

/// 0, or errno. A handle that another program has made non-blocking is waited for.
int write_whole(int handle, const char* bytes, std::size_t count) {
    while (count > 0) {
        const ssize_t written = ::write(handle, bytes, count);
        if (written >= 0) {
            bytes += written;
            count -= static_cast<std::size_t>(written);
        } else if (errno == EAGAIN) {
            wait_until_writable(handle);
        } else if (errno != EINTR) {
            return errno;
        }
    }
    return 0;
}

/// Of fopencookie: says that all was written.
ssize_t take_output(void* cookie, const char* bytes, std::size_t count) {
    auto& sink = *static_cast<OutputSink*>(cookie);
    if (!sink.lasting || sink.failure == 0) {
        if (const int failure = write_whole(sink.handle, bytes, count); failure != 0) {
            int none = 0;
            sink.failure.compare_exchange_strong(none, failure);
        }
    }
    return static_cast<ssize_t>(count);
}

std::FILE* guarded(OutputSink& sink, int buffering) {
    std::FILE* const stream = ::fopencookie(&sink, "w", {nullptr, take_output, nullptr, nullptr});
    if (stream != nullptr) {
        std::setvbuf(stream, nullptr, buffering, BUFSIZ);
    }
    return stream;
}

/// A handle that can neither be read nor written.
void take_missing_handles() {
    for (int handle = STDIN_FILENO; handle <= STDERR_FILENO; ++handle) {
        if (::fcntl(handle, F_GETFD) < 0) { // then it is the lowest free number
            (void)::open("/", O_RDONLY | O_DIRECTORY);
        }
    }
}

} // namespace

void guard_output_streams() {
    take_missing_handles();
    (void)std::signal(SIGXFSZ, SIG_IGN);
    if (std::FILE* const stream = guarded(standard_output, ::isatty(STDOUT_FILENO) == 1 ? _IOLBF : _IOFBF)) {
        stdout = stream;
    }
    if (std::FILE* const stream = guarded(standard_error, _IONBF)) {
        stderr = stream;
    }
}

bool error_takes_text() {
    pollfd waiting{STDERR_FILENO, POLLOUT, 0};
    return ::poll(&waiting, 1, 0) == 1;
}

int output_failure() {
    std::fflush(stdout);
    return standard_output.failure;
}

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
