#include "core/machine/links/pseudo_terminal.h"

#include "core/base/error.h"
#include "core/machine/links/internal/pump_link.h"

#include <boost/asio/posix/stream_descriptor.hpp>
#include <fcntl.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>

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
    port_->close();
    if (near_handle_ < 0) {
        return;
    }
    ::close(near_handle_);
    near_handle_ = -1;
    std::error_code ignored;
    if (!symlink_.empty() && fs::read_symlink(symlink_, ignored) == near_end_) {
        fs::remove(symlink_, ignored);
    }
}

} // namespace millwright::machine
