#include "core/links/tcp_link.h"

#include "core/base/error.h"
#include "core/links/internal/pump_link.h"

#include <boost/asio/connect.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <fmt/format.h>

namespace millwright::links {

using boost::asio::ip::tcp;

struct TcpLink::Port : internal::PumpLink<tcp::socket> {};

namespace {

/// The connect of a blocking socket can wait for minutes, so it is made asynchronous and given a limit.
void connect(tcp::socket& socket, const std::string& host, std::uint16_t port) {
    constexpr auto patience = std::chrono::seconds(5);
    boost::asio::io_context context;
    tcp::resolver resolver(context);
    const auto places = resolver.resolve(host, fmt::format("{}", port));
    tcp::socket attempt(context);
    boost::system::error_code result = boost::asio::error::timed_out;
    const auto done = [&](const boost::system::error_code& code, const tcp::endpoint&) { result = code; };
    boost::asio::async_connect(attempt, places, done);
    context.run_for(patience);
    if (result) {
        throw boost::system::system_error(result);
    }
    const tcp protocol = attempt.remote_endpoint().protocol();
    socket.assign(protocol, attempt.release());
    socket.set_option(tcp::no_delay(true));
}

} // namespace

TcpLink::TcpLink(std::string host, std::uint16_t port)
    : host_(std::move(host)), number_(port), port_(std::make_unique<Port>()) {}

TcpLink::~TcpLink() = default;

std::string TcpLink::name() const {
    return fmt::format("tcp:{}:{}", host_, number_);
}

void TcpLink::open() {
    try {
        port_->close();
        port_->open([this](tcp::socket& socket) { connect(socket, host_, number_); });
    } catch (const boost::system::system_error& failure) {
        throw Error(fmt::format("cannot connect to {}: {}", name(), failure.code().message()));
    }
}

void TcpLink::write(std::string_view bytes) {
    port_->write(bytes);
}

std::string TcpLink::read() {
    return port_->read();
}

void TcpLink::wait(double seconds) {
    port_->wait(seconds);
}

std::optional<std::string> TcpLink::lost() const {
    const std::optional<std::string> why = port_->lost();
    const std::string first = port_->first_line();
    const std::size_t holder_end = first.find(" holds this port");
    constexpr std::string_view busy = "busy: "; // so says a TcpServer that has a client already
    if (!why || !first.starts_with(busy) || holder_end == std::string::npos) {
        return why;
    }
    return fmt::format("{}, {}", held_by_another, first.substr(busy.size(), holder_end - busy.size()));
}

void TcpLink::close() noexcept {
    port_->close();
}

} // namespace millwright::links
