#include "core/links/host_port_link.h"

#include "core/base/error.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

namespace millwright::links {

namespace {

class IoPorts final : public PortRegisters {
public:
    explicit IoPorts(int base) : base_(base) {}
    IoPorts(const IoPorts&) = delete;
    IoPorts& operator=(const IoPorts&) = delete;
    ~IoPorts() override { close_file(); }

    [[nodiscard]] std::string name() const override { return fmt::format("isa:0x{:X}", base_); }
    void open() override {
        close_file();
        file_ = ::open("/dev/port", O_RDWR | O_CLOEXEC);
        if (file_ < 0) {
            throw Error(
                fmt::format("the registers at 0x{:X} cannot be reached: {}", base_, std::strerror(errno)),
                "/dev/port",
                "this requires root and a computer with an ISA bus");
        }
    }
    void close() noexcept override { close_file(); }
    [[nodiscard]] std::uint8_t read(int offset) override {
        std::uint8_t value = no_card;
        return ::pread(file_, &value, 1, base_ + offset) == 1 ? value : no_card;
    }
    void write(int offset, std::uint8_t value) override {
        if (::pwrite(file_, &value, 1, base_ + offset) != 1) {
            throw Error(
                fmt::format("the register at 0x{:X} was not written: {}", base_, std::strerror(errno)),
                "/dev/port");
        }
    }

private:
    void close_file() noexcept {
        if (file_ >= 0) {
            ::close(file_);
            file_ = -1;
        }
    }

    int base_;
    int file_ = -1;
};

} // namespace

std::unique_ptr<PortRegisters> io_ports(int base) {
    return std::make_unique<IoPorts>(base);
}

namespace {

constexpr int status_register = 2, high_register = 5, middle_register = 6, data_register = 7; // registers
constexpr unsigned readable_bit = 1, writable_bit = 2; // bits of the status
constexpr double card_patience = 0.5;                  // s

} // namespace

HostPortLink::HostPortLink(std::unique_ptr<PortRegisters> registers, std::unique_ptr<Clock> clock)
    : registers_(std::move(registers)), clock_(std::move(clock)) {}

void HostPortLink::open() {
    const std::scoped_lock lock(mutex_);
    registers_->open();
    if (registers_->read(status_register) == no_card) {
        registers_->close();
        throw Error("no card answers at " + registers_->name(), {}, "check the address jumpers of the card");
    }
    registers_->write(high_register, 0);
    registers_->write(middle_register, 0);
    out_.clear();
    in_.clear();
    taken_at_ = clock_->now();
    lost_.reset();
}

void HostPortLink::close() noexcept {
    const std::scoped_lock lock(mutex_);
    registers_->close();
    lost_ = "the port is not open";
}

/// As much as the card takes and gives now.
void HostPortLink::pump() {
    constexpr int most = 4096; // characters, so that a card that never stops talking blocks no caller
    const double now = clock_->now();
    for (int n = 0; n < most && !lost_; ++n) {
        const std::uint8_t ready = registers_->read(status_register);
        if (ready == no_card) {
            lost_ = "the card no longer answers";
        } else if ((ready & readable_bit) != 0) {
            in_ += static_cast<char>(registers_->read(data_register));
        } else if (!out_.empty() && (ready & writable_bit) != 0) {
            registers_->write(data_register, static_cast<std::uint8_t>(out_.front()));
            out_.pop_front();
            taken_at_ = now;
        } else {
            break;
        }
    }
    taken_at_ = out_.empty() ? now : taken_at_;
    if (!lost_ && now - taken_at_ > card_patience) {
        lost_ = "the card accepts no characters";
    }
}

void HostPortLink::write(std::string_view bytes) {
    const std::scoped_lock lock(mutex_);
    if (!lost_) {
        out_.insert(out_.end(), bytes.begin(), bytes.end());
        pump();
    }
}

std::string HostPortLink::read() {
    const std::scoped_lock lock(mutex_);
    pump();
    return std::exchange(in_, {});
}

void HostPortLink::wait(double seconds) {
    constexpr double glance = 0.0005;
    for (const double end = clock_->now() + seconds; clock_->now() < end;) {
        {
            const std::scoped_lock lock(mutex_);
            pump();
            if (!in_.empty() || lost_) {
                return;
            }
        }
        clock_->wait(std::min(glance, seconds));
    }
}

std::optional<std::string> HostPortLink::lost() const {
    const std::scoped_lock lock(mutex_);
    return lost_;
}

} // namespace millwright::links
