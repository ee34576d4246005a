// A serial port, or a pseudo-terminal that takes its place.
#pragma once

#include "core/links/link.h"
#include "core/links/serial_address.h"

#include <string>
#include <utility>

namespace millwright::links {

/// Without flow control.
class SerialLink final : public Link {
public:
    explicit SerialLink(SerialAddress address);
    /// With the usual line.
    explicit SerialLink(std::string path) : SerialLink(SerialAddress{std::move(path), {}}) {}
    SerialLink(const SerialLink&) = delete;
    SerialLink& operator=(const SerialLink&) = delete;
    ~SerialLink() override;

    [[nodiscard]] std::string name() const override { return address_of(address_); }
    void open() override;
    void write(std::string_view bytes) override;
    [[nodiscard]] std::string read() override;
    void wait(double seconds) override;
    [[nodiscard]] std::optional<std::string> lost() const override;
    void close() noexcept override;
    [[nodiscard]] std::optional<double> rate() const override { return bytes_per_second(address_.line); }

private:
    struct Port;
    SerialAddress address_;
    std::unique_ptr<Port> port_;
};

} // namespace millwright::links
