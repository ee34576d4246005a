#include "core/exchange/internal/cad_child.h"

#include "core/base/error.h"
#include "core/base/program_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
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

} // namespace

CadChild::CadChild(const std::filesystem::path& file) {
    std::string path = cad_program(file);
    std::array<int, 2> said{};
    if (::pipe2(said.data(), O_CLOEXEC) != 0) {
        throw Error("no pipe can be made", file);
    }
    posix_spawn_file_actions_t files{};
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, said[1], STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    std::string argument = file.string();
    std::array<char*, 3> argv{path.data(), argument.data(), nullptr};
    const int fault = ::posix_spawn(&child_, path.c_str(), &files, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    ::close(said[1]);
    said_ = said[0];
    if (fault != 0) {
        ::close(said_);
        throw Error(fmt::format("{} cannot be started: {}", path, std::strerror(fault)), file);
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
