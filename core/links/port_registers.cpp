#include "core/links/port_registers.h"

#include "core/base/error.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

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

} // namespace millwright::links
