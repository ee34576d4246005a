// A TCP connection to a controller with a network port, or to an emulator.
#pragma once

#include "core/links/link.h"

#include <cstdint>

namespace millwright::links {

class TcpLink final : public Link {
public:
    TcpLink(std::string host, std::uint16_t port);
    TcpLink(const TcpLink&) = delete;
    TcpLink& operator=(const TcpLink&) = delete;
    ~TcpLink() override;

    [[nodiscard]] std::string name() const override;
    /// Waits for an answer at most 5 s.
    void open() override;
    void write(std::string_view bytes) override;
    [[nodiscard]] std::string read() override;
    void wait(double seconds) override;
    /// If the other end said that it is busy, this is what it said.
    [[nodiscard]] std::optional<std::string> lost() const override;
    void close() noexcept override;

private:
    struct Port;
    std::string host_;
    std::uint16_t number_;
    std::unique_ptr<Port> port_;
};

} // namespace millwright::links
