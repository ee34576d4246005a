#include "core/exchange/internal/cad_child.h"

#include "core/base/error.h"
#include "core/base/program_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <utility>

namespace millwright::exchange {

namespace {

/// In the build folder or where it is installed.
std::string cad_program(const std::filesystem::path& file) {
    const auto found = find_above(executable(), {"millwright-cad", "libexec/millwright/millwright-cad"});
    if (!found) {
        throw Error("millwright-cad, which reads STEP and IGES files, is not installed", file);
    }
    return found->string();
}

struct Descriptor {
    int number = -1;

    explicit Descriptor(int opened) : number(opened) {}
    Descriptor(Descriptor&& other) noexcept : number(std::exchange(other.number, -1)) {}
    Descriptor& operator=(Descriptor&&) = delete;
    ~Descriptor() { ::close(number); }
};

/// `bytes` as a file to be read from its beginning. Unlike a pipe it takes them all at once.
Descriptor in_memory(std::string_view bytes, const std::filesystem::path& file) {
    Descriptor memory(::memfd_create("millwright", MFD_CLOEXEC));
    while (memory.number >= 0 && !bytes.empty()) {
        const ssize_t count = ::write(memory.number, bytes.data(), bytes.size());
        if (count <= 0) {
            break;
        }
        bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    if (memory.number < 0 || !bytes.empty() || ::lseek(memory.number, 0, SEEK_SET) != 0) {
        throw Error("not enough memory to pass on the surface", file);
    }
    return memory;
}

} // namespace

CadChild::CadChild(std::vector<std::string> arguments,
                   std::string_view input,
                   const std::filesystem::path& file) {
    arguments.insert(arguments.begin(), cad_program(file));
    std::vector<char*> argv;
    for (std::string& argument : arguments) {
        argv.push_back(argument.data());
    }
    argv.push_back(nullptr);
    const Descriptor heard = in_memory(input, file);
    std::array<int, 2> said{};
    if (::pipe2(said.data(), O_CLOEXEC) != 0) {
        throw Error("no pipe can be created", file);
    }
    posix_spawn_file_actions_t files{};
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, heard.number, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&files, said[1], STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    // Ends with who reads it, and with a disk that is full, also where this program ignores such signals.
    posix_spawnattr_t usual{};
    sigset_t ending{};
    sigemptyset(&ending);
    sigaddset(&ending, SIGPIPE);
    sigaddset(&ending, SIGXFSZ);
    posix_spawnattr_init(&usual);
    posix_spawnattr_setflags(&usual, POSIX_SPAWN_SETSIGDEF);
    posix_spawnattr_setsigdefault(&usual, &ending);
    const int fault = ::posix_spawn(&child_, argv.front(), &files, &usual, argv.data(), environ);
    posix_spawnattr_destroy(&usual);
    posix_spawn_file_actions_destroy(&files);
    ::close(said[1]);
    said_ = said[0];
    if (fault != 0) {
        ::close(said_);
        throw Error(fmt::format("{} cannot be started: {}", arguments.front(), std::strerror(fault)), file);
    }
}

CadChild::~CadChild() {
    if (child_ > 0) {
        ::kill(child_, SIGKILL);
        ::waitpid(child_, nullptr, 0);
    }
    ::close(said_);
}

bool CadChild::listen(std::string& stream) {
    constexpr int patience_ms = 20;
    pollfd handle{said_, POLLIN, 0};
    if (::poll(&handle, 1, patience_ms) <= 0) {
        return true;
    }
    std::array<char, 65536> buffer{};
    const ssize_t count = ::read(said_, buffer.data(), buffer.size());
    if (count > 0) {
        stream.append(buffer.data(), static_cast<std::size_t>(count));
    }
    return count > 0;
}

std::string CadChild::end() {
    int status = 0;
    ::waitpid(std::exchange(child_, -1), &status, 0);
    if (WIFSIGNALED(status)) {
        return fmt::format("by signal {}", WTERMSIG(status));
    }
    return WEXITSTATUS(status) == 0 ? "" : fmt::format("with exit code {}", WEXITSTATUS(status));
}

} // namespace millwright::exchange
