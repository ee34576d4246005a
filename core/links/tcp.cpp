#include "core/links/tcp.h"

#include "core/base/error.h"
#include "core/links/internal/pump_link.h"

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

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

using boost::asio::ip::tcp;
using Failure = boost::system::error_code;

/// Everything of Asio happens in its one thread; the mutex guards what is handed over.
class TcpServer::Listener {
public:
    Listener(const std::string& address, std::uint16_t port)
        : acceptor_(context_, tcp::endpoint(boost::asio::ip::make_address(address), port)), client_(context_),
          visitor_(context_) {
        accept_more();
        thread_ = std::jthread([this] { context_.run(); });
    }
    Listener(const Listener&) = delete;
    Listener& operator=(const Listener&) = delete;
    ~Listener() { context_.stop(); }

    [[nodiscard]] std::uint16_t port() const { return acceptor_.local_endpoint().port(); }
    [[nodiscard]] std::string holder() const {
        const std::scoped_lock lock(mutex_);
        return holder_;
    }
    void write(std::string_view bytes) {
        boost::asio::post(context_, [this, copy = std::string(bytes)] {
            if (client_.is_open()) {
                waiting_ += copy;
                if (waiting_.size() > most_waiting) { // of one who does not listen
                    Failure ignored;
                    waiting_.clear();
                    client_.shutdown(tcp::socket::shutdown_both, ignored);
                }
                write_more();
            }
        });
    }
    [[nodiscard]] int visits() const {
        const std::scoped_lock lock(mutex_);
        return visits_;
    }
    [[nodiscard]] std::string read() {
        const std::scoped_lock lock(mutex_);
        if (std::exchange(full_, false)) {
            boost::asio::post(context_, [this] { read_more(); });
        }
        return std::exchange(received_, {});
    }
    void wait(double seconds) {
        std::unique_lock lock(mutex_);
        changed_.wait_for(
            lock, std::chrono::duration<double>(seconds), [this] { return !received_.empty(); });
    }

private:
    static constexpr std::size_t most_waiting = std::size_t{1} << 20U;  ///< bytes, 1 MiB
    static constexpr std::size_t most_received = std::size_t{1} << 20U; ///< then the client has to wait
    static constexpr std::chrono::milliseconds longest_farewell{100};

    void accept_more() {
        acceptor_.async_accept(visitor_, [this](const Failure& failure) {
            if (failure == boost::asio::error::operation_aborted) {
                return;
            }
            if (!failure) {
                welcome_or_keep_waiting();
            }
            visitor_ = tcp::socket(context_);
            accept_more();
        });
    }

    /// A visitor that came while another one held the port. What it says once it is refused is read until it
    /// leaves: a socket closed over unread bytes would take the reason away from it.
    struct Waiting {
        Waiting(boost::asio::io_context& context, tcp::socket visitor)
            : socket(std::move(visitor)), patience(context) {}
        tcp::socket socket;
        boost::asio::steady_timer patience;
        std::array<char, 256> chunk{};
    };

    /// A client that left just before is often seen to leave just after: the next one waits a moment for it.
    void welcome_or_keep_waiting() {
        if (!client_.is_open()) {
            welcome(std::move(visitor_));
            return;
        }
        auto next = std::make_shared<Waiting>(context_, std::move(visitor_));
        queue_.push_back(next);
        next->patience.expires_after(longest_farewell);
        next->patience.async_wait([this, next](const Failure&) {
            if (std::erase(queue_, next) > 0) {
                refuse(next);
            }
        });
    }

    void welcome(tcp::socket visitor) {
        Failure ignored;
        client_ = std::move(visitor);
        client_.set_option(tcp::no_delay(true), ignored);
        waiting_.clear();
        const auto far_end = client_.remote_endpoint(ignored);
        {
            const std::scoped_lock lock(mutex_);
            ++visits_;
            holder_ = fmt::format("{}:{}", far_end.address().to_string(), far_end.port());
        }
        read_more();
    }

    void refuse(const std::shared_ptr<Waiting>& refused) {
        Failure ignored;
        const std::string sorry = fmt::format("busy: {} holds this port\r\n", holder());
        boost::asio::write(refused->socket, boost::asio::buffer(sorry), ignored);
        refused->socket.shutdown(tcp::socket::shutdown_send, ignored);
        refused->patience.expires_after(std::chrono::seconds(2));
        refused->patience.async_wait([refused](const Failure&) {
            Failure closing;
            refused->socket.close(closing);
        });
        read_on(refused);
    }

    static void read_on(const std::shared_ptr<Waiting>& refused) {
        refused->socket.async_read_some(boost::asio::buffer(refused->chunk),
                                        [refused](const Failure& failure, std::size_t) {
                                            if (failure) {
                                                refused->patience.cancel();
                                            } else {
                                                read_on(refused);
                                            }
                                        });
    }

    void read_more() {
        client_.async_read_some(boost::asio::buffer(chunk_), [this](const Failure& failure, std::size_t n) {
            if (failure) {
                drop_client();
                return;
            }
            bool full = false;
            {
                const std::scoped_lock lock(mutex_);
                received_.append(chunk_.data(), n);
                full = full_ = received_.size() >= most_received;
            }
            changed_.notify_all();
            if (!full) {
                read_more();
            }
        });
    }

    void write_more() {
        if (!sending_.empty() || waiting_.empty()) {
            return;
        }
        std::swap(sending_, waiting_);
        const auto sent = [this, to = visits_](const Failure& failure, std::size_t) {
            sending_.clear();
            const bool left = to != visits_; // the client whose bytes these were
            if (!failure || left) {
                write_more();
            }
        };
        boost::asio::async_write(client_, boost::asio::buffer(sending_), sent);
    }

    void drop_client() {
        Failure ignored;
        client_.close(ignored);
        {
            const std::scoped_lock lock(mutex_);
            holder_.clear();
        }
        if (!queue_.empty()) {
            const std::shared_ptr<Waiting> next = queue_.front();
            queue_.pop_front();
            next->patience.cancel();
            welcome(std::move(next->socket));
        }
    }

    boost::asio::io_context context_;
    tcp::acceptor acceptor_;
    tcp::socket client_, visitor_;
    std::deque<std::shared_ptr<Waiting>> queue_; ///< for the client to leave
    std::string waiting_, sending_;
    std::array<char, 4096> chunk_{};
    mutable std::mutex mutex_; ///< guards holder_, received_, full_ and visits_
    int visits_ = 0;
    std::condition_variable changed_;
    bool full_ = false; ///< nothing is read until what came is taken
    std::string holder_, received_;
    std::jthread thread_; ///< last: ends before what it uses
};

TcpServer::TcpServer(std::uint16_t port, std::string address) : port_(port), address_(std::move(address)) {}

TcpServer::~TcpServer() = default;

std::uint16_t TcpServer::port() const {
    return listener_ ? listener_->port() : port_;
}

std::string TcpServer::holder() const {
    return listener_ ? listener_->holder() : std::string();
}

int TcpServer::visits() const {
    return listener_ ? listener_->visits() : 0;
}

std::string TcpServer::name() const {
    return fmt::format("tcp:{}:{}", address_, port());
}

void TcpServer::open() {
    close();
    try {
        listener_ = std::make_unique<Listener>(address_, port_);
    } catch (const boost::system::system_error& failure) {
        throw Error(fmt::format("cannot listen on {}: {}", name(), failure.code().message()));
    }
}

void TcpServer::write(std::string_view bytes) {
    if (listener_) {
        listener_->write(bytes);
    }
}

std::string TcpServer::read() {
    return listener_ ? listener_->read() : std::string();
}

void TcpServer::wait(double seconds) {
    if (listener_) {
        listener_->wait(seconds);
    }
}

std::optional<std::string> TcpServer::lost() const {
    return listener_ ? std::nullopt : std::optional<std::string>("the server is not listening");
}

void TcpServer::close() noexcept {
    listener_.reset();
}

} // namespace millwright::links
