#include "core/machine/links/pseudo_terminal.h"

#include "core/base/error.h"
#include "core/machine/links/internal/pump_link.h"

#include <boost/asio/posix/stream_descriptor.hpp>
#include <fcntl.h>
#include <fmt/format.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <system_error>
#include <utility>
#include <vector>

namespace millwright::machine {

namespace fs = std::filesystem;
using boost::asio::posix::stream_descriptor;

struct PseudoTerminal::Port : internal::PumpLink<stream_descriptor> {};

namespace {

[[noreturn]] void fail(const char* what) {
    const std::error_code why(errno, std::generic_category());
    throw Error(std::string(what) + ": " + why.message());
}

/// Bytes as they are: no echo, no lines, no translation.
void make_raw(int handle) {
    termios settings{};
    if (::tcgetattr(handle, &settings) != 0) {
        fail("cannot read the settings of a pseudo-terminal");
    }
    ::cfmakeraw(&settings);
    if (::tcsetattr(handle, TCSANOW, &settings) != 0) {
        fail("cannot set up a pseudo-terminal");
    }
}

std::string first_line(const fs::path& file) {
    std::ifstream stream(file);
    std::string line;
    std::getline(stream, line);
    return line;
}

/// Whether this is the far end of terminal `number`, by what Linux tells of an open file.
bool is_far_end(const fs::path& descriptor, const std::string& number) {
    std::ifstream info(descriptor.parent_path().parent_path() / "fdinfo" / descriptor.filename());
    for (std::string key, value; info >> key >> value;) {
        if (key == "tty-index:") {
            return value == number;
        }
    }
    return false;
}

/// Nothing of a folder that is hidden, or goes meanwhile.
std::vector<fs::path> entries_of(const fs::path& folder) {
    std::vector<fs::path> entries;
    std::error_code gone;
    for (fs::directory_iterator entry(folder, gone); entry != fs::directory_iterator() && !gone;
         entry.increment(gone)) {
        entries.push_back(entry->path());
    }
    return entries;
}

/// Of the processes that this user may look into; empty: none of them.
std::string holder_of(const fs::path& near_end) {
    for (const fs::path& process : entries_of("/proc")) {
        const std::string id = process.filename().string();
        if (id.find_first_not_of("0123456789") != std::string::npos) {
            continue;
        }
        for (const fs::path& descriptor : entries_of(process / "fd")) {
            if (is_far_end(descriptor, near_end.filename().string())) {
                return fmt::format(", which {} (process {}) holds", first_line(process / "comm"), id);
            }
        }
    }
    return {};
}

} // namespace

PseudoTerminal::PseudoTerminal(fs::path symlink)
    : symlink_(std::move(symlink)), port_(std::make_unique<Port>()) {}

PseudoTerminal::~PseudoTerminal() {
    close();
}

fs::path PseudoTerminal::path() const {
    return near_end_;
}

std::string PseudoTerminal::name() const {
    return symlink_.empty() ? near_end_ : symlink_.string();
}

void PseudoTerminal::open() {
    close();
    const int far_end = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (far_end < 0 || ::grantpt(far_end) != 0 || ::unlockpt(far_end) != 0) {
        fail("cannot make a pseudo-terminal");
    }
    port_->open([far_end](stream_descriptor& descriptor) { descriptor.assign(far_end); });
    std::string path(256, '\0');
    if (::ptsname_r(far_end, path.data(), path.size()) != 0) {
        fail("cannot find the name of a pseudo-terminal");
    }
    near_end_ = path.c_str();
    near_handle_ = ::open(near_end_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (near_handle_ < 0) {
        fail("cannot open a pseudo-terminal");
    }
    make_raw(near_handle_);
    make_symlink();
}

void PseudoTerminal::make_symlink() {
    if (symlink_.empty()) {
        return;
    }
    std::error_code failure;
    if (fs::is_symlink(symlink_, failure)) {
        const fs::path target = fs::read_symlink(symlink_, failure);
        if (target != near_end_ && fs::exists(symlink_, failure)) {
            throw Error(fmt::format("leads to {} already{}", target.string(), holder_of(target)),
                        symlink_,
                        "choose another link, end that program, or take the link away if it is an old one");
        }
        fs::remove(symlink_, failure);
    }
    fs::create_symlink(near_end_, symlink_, failure);
    if (failure) {
        throw Error("cannot make the link to the pseudo-terminal: " + failure.message(), symlink_);
    }
}

void PseudoTerminal::write(std::string_view bytes) {
    port_->write(bytes);
}

std::string PseudoTerminal::read() {
    return port_->read();
}

void PseudoTerminal::wait(double seconds) {
    port_->wait(seconds);
}

std::optional<std::string> PseudoTerminal::lost() const {
    return port_->lost();
}

void PseudoTerminal::close() noexcept {
    if (near_handle_ >= 0) {
        std::error_code ignored; // before the terminal ends, and another may have its name
        if (!symlink_.empty() && fs::read_symlink(symlink_, ignored) == near_end_) {
            fs::remove(symlink_, ignored);
        }
        ::close(near_handle_);
        near_handle_ = -1;
    }
    port_->close();
}

} // namespace millwright::machine
