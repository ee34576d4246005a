// TCP connections: the link to a controller with a network port, and the listening end for emulators.
#pragma once

#include "core/links/link.h"

#include <cstdint>

namespace millwright::links {

// A TCP connection to a controller with a network port, or to an emulator.

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

// The listening end of a TCP connection. One client at a time holds it; another one waits a moment in case
// that one is just leaving, and then learns who it is and is sent away.

class TcpServer final : public Link {
public:
    /// Port 0: any free one. The address is this computer's own unless another one is named.
    explicit TcpServer(std::uint16_t port, std::string address = "127.0.0.1");
    TcpServer(const TcpServer&) = delete;
    TcpServer& operator=(const TcpServer&) = delete;
    ~TcpServer() override;

    /// Listened on, once open.
    [[nodiscard]] std::uint16_t port() const;
    /// The client that holds it, as 127.0.0.1:40512; empty if there is no client.
    [[nodiscard]] std::string holder() const;

    [[nodiscard]] std::string name() const override;
    void open() override;
    /// To the client, if there is one.
    void write(std::string_view bytes) override;
    [[nodiscard]] std::string read() override;
    void wait(double seconds) override;
    /// Clients come and go; the link is lost only when the server no longer listens.
    [[nodiscard]] std::optional<std::string> lost() const override;
    void close() noexcept override;
    [[nodiscard]] int visits() const override;

private:
    class Listener;
    std::uint16_t port_;
    std::string address_;
    std::unique_ptr<Listener> listener_;
};

} // namespace millwright::links
