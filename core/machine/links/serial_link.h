// A serial port, or a pseudo-terminal that takes its place.
#pragma once

#include "core/machine/links/link.h"

namespace millwright::machine {

/// 8 data bits, no parity, 1 stop bit, no flow control.
class SerialLink final : public Link {
public:
    explicit SerialLink(std::string path, unsigned baud = 115200);
    SerialLink(const SerialLink&) = delete;
    SerialLink& operator=(const SerialLink&) = delete;
    ~SerialLink() override;

    [[nodiscard]] std::string name() const override { return path_; }
    void open() override;
    void write(std::string_view bytes) override;
    [[nodiscard]] std::string read() override;
    void wait(double seconds) override;
    [[nodiscard]] std::optional<std::string> lost() const override;
    void close() noexcept override;

private:
    struct Port;
    std::string path_;
    unsigned baud_;
    std::unique_ptr<Port> port_;
};

} // namespace millwright::machine
