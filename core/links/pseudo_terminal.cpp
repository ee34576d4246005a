#include "core/links/pseudo_terminal.h"

#include "core/base/error.h"
#include "core/links/internal/open_files.h"
#include "core/links/internal/pump_link.h"

#include <boost/asio/posix/stream_descriptor.hpp>
#include <fcntl.h>
#include <fmt/format.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>
#include <utility>
#include <vector>

namespace millwright::links {

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

/// Part of a sentence; empty: no process that this user may look into.
std::string holder_of(const fs::path& near_end) {
    const std::vector<std::string> holders = internal::holders_of_far_end(near_end);
    return holders.empty() ? std::string() : fmt::format(", which is in use by {}", holders.front());
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
        fail("cannot create a pseudo-terminal");
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
            throw Error(fmt::format("already leads to {}{}", target.string(), holder_of(target)),
                        symlink_,
                        "choose another link, end that program, or delete the link if it is an old one");
        }
        fs::remove(symlink_, failure);
    }
    fs::create_symlink(near_end_, symlink_, failure);
    if (failure) {
        throw Error("cannot create the link to the pseudo-terminal: " + failure.message(), symlink_);
    }
}

void PseudoTerminal::write(std::string_view bytes) {
    port_->write_or_drop(bytes);
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

} // namespace millwright::links
