#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/program_files.h"
#include "core/exchange/cad_file.h"
#include "core/exchange/internal/cad_frames.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace millwright::exchange {

// A running millwright-cad.

class CadChild {
public:
    /// With `input` on its standard input. Throws Error about `file` if it cannot be started.
    CadChild(std::vector<std::string> arguments, std::string_view input, const std::filesystem::path& file);
    CadChild(const CadChild&) = delete;
    CadChild& operator=(const CadChild&) = delete;
    ~CadChild(); ///< kills it if it still runs

    /// Appends what it has said, waiting for it at most 20 ms. False once it says no more.
    [[nodiscard]] bool listen(std::string& stream);
    /// Waits for its end. Empty if that was as it should be, else how it ended, as a sentence's rest.
    [[nodiscard]] std::string end();

private:
    pid_t child_ = -1;
    int said_ = -1;
};

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

// Reading and writing STEP and IGES files by a child process, millwright-cad.

namespace {

/// An empty file in the folder for temporary files, removed with the object.
class ScratchFile {
public:
    ScratchFile() : path_((std::filesystem::temp_directory_path() / "millwright-XXXXXX.step").string()) {
        constexpr int suffix = 5;
        const int handle = ::mkstemps(path_.data(), suffix);
        if (handle < 0) {
            throw Error("the file cannot be created", path_);
        }
        ::close(handle);
    }
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;
    ~ScratchFile() {
        std::error_code gone_already;
        std::filesystem::remove(path_, gone_already);
    }
    [[nodiscard]] const std::string& path() const { return path_; }

private:
    std::string path_;
};

/// The model that the child sends. Throws the error that it reports, about `file`, or "DAMAGE: Open CASCADE
/// ends
/// ..." if it ends without either.
CadModel answer_of(CadChild child,
                   const std::filesystem::path& file,
                   std::string_view damage,
                   const Progress& progress) {
    std::optional<CadModel> model;
    std::string stream;
    for (bool talks = true; talks;) {
        progress.check();
        talks = child.listen(stream);
        while (const auto frame = take_frame(stream)) {
            if (frame->kind == FrameKind::model) {
                model = unpacked(frame->bytes);
            } else if (frame->kind == FrameKind::error) {
                Diagnostic diagnostic = told_error(*frame);
                diagnostic.place.file = file;
                throw Error(std::move(diagnostic));
            } else {
                const Progress::Report report = told_progress(*frame);
                progress.report(report.fraction, report.text);
            }
        }
    }
    const std::string fault = child.end();
    if (!fault.empty() || !model) {
        throw Error(
            fmt::format(
                "{}: Open CASCADE stopped unexpectedly{}{}", damage, fault.empty() ? "" : ", ", fault),
            file);
    }
    return std::move(*model);
}

} // namespace

bool reads_cad_files() {
    return true;
}

CadModel read_cad(const std::filesystem::path& file, const Progress& progress) {
    return answer_of(CadChild({"read", file.string()}, {}, file), file, "the file is damaged", progress);
}

void write_step(const geometry::Surface& surface,
                const std::filesystem::path& file,
                const Progress& progress) {
    const ScratchFile scratch;
    CadModel model;
    model.faces.emplace_back().patches = surface.patches();
    progress.report(0.0, "making the faces");
    (void)answer_of(CadChild({"write", scratch.path(), file.stem().string()}, packed(model), file),
                    file,
                    "the surface cannot be written as STEP",
                    progress.part(0.0, 0.9));
    progress.report(0.9, "writing the file");
    progress.check(); // from here on the old file is gone
    write_file(file, read_file(scratch.path()));
    progress.report(1.0);
}

} // namespace millwright::exchange
