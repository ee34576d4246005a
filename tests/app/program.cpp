#include "tests/app/program.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace millwright::test {

namespace {

std::vector<char*> environment_without_display() {
    std::vector<char*> kept;
    for (char** entry = environ; *entry != nullptr; ++entry) {
        const bool display =
            std::strncmp(*entry, "DISPLAY=", 8) == 0 || std::strncmp(*entry, "WAYLAND_DISPLAY=", 16) == 0;
        if (!display) {
            kept.push_back(*entry);
        }
    }
    kept.push_back(nullptr);
    return kept;
}

/// Appends what can be read now; closes `handle` at its end.
void take(int& handle, std::string& to) {
    std::array<char, 4096> buffer{};
    const ssize_t count = ::read(handle, buffer.data(), buffer.size());
    if (count > 0) {
        to.append(buffer.data(), static_cast<std::size_t>(count));
        return;
    }
    ::close(handle);
    handle = -1;
}

} // namespace

Program::Program(const std::vector<std::string>& arguments,
                 const std::string& input,
                 const std::vector<std::string>& launcher) {
    std::array<int, 2> in{};
    std::array<int, 2> out{};
    std::array<int, 2> err{};
    for (auto* pipe : {&in, &out, &err}) {
        if (::pipe2(pipe->data(), O_CLOEXEC) != 0) {
            throw std::runtime_error("no pipe");
        }
    }
    if (::write(in[1], input.data(), input.size()) != static_cast<ssize_t>(input.size())) {
        throw std::runtime_error("the input does not fit into a pipe");
    }
    in_ = in[1];
    posix_spawn_file_actions_t files{};
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, in[0], STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&files, out[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&files, err[1], STDERR_FILENO);
    std::vector<std::string> words = launcher;
    words.push_back(program_file().string());
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) {
        argv.push_back(word.data());
    }
    argv.push_back(nullptr);
    const int failure = ::posix_spawnp(
        &child_, argv.front(), &files, nullptr, argv.data(), environment_without_display().data());
    posix_spawn_file_actions_destroy(&files);
    ::close(in[0]);
    ::close(out[1]);
    ::close(err[1]);
    out_ = out[0];
    err_ = err[0];
    if (failure != 0) {
        throw std::runtime_error("cannot start " + words.front());
    }
}

Program::~Program() {
    if (child_ > 0) {
        ::kill(child_, SIGKILL);
        ::waitpid(child_, nullptr, 0);
    }
    for (const int handle : {in_, out_, err_}) {
        if (handle >= 0) {
            ::close(handle);
        }
    }
}

bool Program::read_some() {
    if (out_ < 0 && err_ < 0) {
        return false;
    }
    std::array<pollfd, 2> handles{{{out_, POLLIN, 0}, {err_, POLLIN, 0}}}; // a negative one is left out
    ::poll(handles.data(), handles.size(), -1);
    if (handles[0].revents != 0) {
        take(out_, ended_.out);
    }
    if (handles[1].revents != 0) {
        take(err_, ended_.err);
    }
    return true;
}

void Program::wait_for_error_text(const std::string& text) {
    while (ended_.err.find(text) == std::string::npos && read_some()) {
    }
}

void Program::send(int signal) const {
    ::kill(child_, signal);
}

void Program::type(const std::string& keys) const {
    if (::write(in_, keys.data(), keys.size()) != static_cast<ssize_t>(keys.size())) {
        throw std::runtime_error("the program does not take the keys");
    }
}

Ended Program::end() {
    ::close(std::exchange(in_, -1));
    while (read_some()) {
    }
    int status = 0;
    ::waitpid(child_, &status, 0);
    child_ = -1;
    ended_.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    return ended_;
}

std::filesystem::path program_file() {
    return MILLWRIGHT_PROGRAM;
}

Ended run(const std::vector<std::string>& arguments, const std::string& input) {
    return Program(arguments, input).end();
}

Ended run_killed_at(int n, const std::vector<std::string>& arguments) {
    return Program(arguments,
                   {},
                   {"env",
                    "LD_PRELOAD=" MILLWRIGHT_KILLER,
                    "ASAN_OPTIONS=verify_asan_link_order=0",
                    "MILLWRIGHT_KILL_AT=" + std::to_string(n)})
        .end();
}

std::filesystem::path small_project(const std::filesystem::path& folder,
                                    const std::string& name,
                                    const std::string& from,
                                    const std::string& to) {
    std::string text = content_of("assets/projects/" + name + ".json");
    const auto replace = [&](const std::string& what, const std::string& by) {
        const auto place = text.find(what);
        if (place == std::string::npos) {
            throw std::runtime_error(what + " is not in the project");
        }
        text.replace(place, what.size(), by);
    };
    if (!from.empty()) {
        replace(from, to);
    }
    for (const auto& [what, by] : {std::pair("\"nu\": 20", "\"nu\": 6"), {"\"nv\": 20", "\"nv\": 6"}}) {
        if (text.find(what) != std::string::npos) {
            replace(what, by);
        }
    }
    const auto file = folder / (name + ".json");
    write_content(file, text);
    return file;
}

std::string content_of(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) {
        throw std::runtime_error("cannot read " + file.string());
    }
    std::ostringstream text;
    text << in.rdbuf();
    return std::move(text).str();
}

void write_content(const std::filesystem::path& file, const std::string& content) {
    std::ofstream(file, std::ios::binary) << content;
}

} // namespace millwright::test
