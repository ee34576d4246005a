// A Link over a Boost.Asio stream: everything but how it is opened.
#pragma once

#include "core/links/link.h"

#include <boost/asio/buffer.hpp>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/write.hpp>

#include <array>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

namespace millwright::links::internal {

// Moves the bytes of one Boost.Asio stream in a thread of its own, until the stream fails or is closed.

/// `Stream` is constructed from an io_context and opened by whoever makes the pump, before start().
template <class Stream> class Pump {
public:
    Pump() : stream_(context_) {}
    Pump(const Pump&) = delete;
    Pump& operator=(const Pump&) = delete;
    ~Pump() { close(); }

    [[nodiscard]] Stream& stream() { return stream_; }

    void start() {
        read_more();
        thread_ = std::jthread([this] { context_.run(); });
    }

    /// As a wire without a receiver: what would be too much is lost.
    void write_or_drop(std::string_view bytes) {
        {
            const std::scoped_lock lock(mutex_);
            if (waiting_.size() + bytes.size() > most_waiting) {
                return;
            }
        }
        write(bytes);
    }

    void write(std::string_view bytes) {
        const std::scoped_lock lock(mutex_);
        if (lost_ || bytes.empty()) {
            return;
        }
        waiting_ += bytes;
        if (waiting_.size() > most_waiting) {
            give_up("the other end accepts no more data");
            return;
        }
        boost::asio::post(context_, [this] { write_more(); });
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
        const auto woken = [this] { return !received_.empty() || lost_.has_value(); };
        changed_.wait_for(lock, std::chrono::duration<double>(seconds), woken);
    }

    [[nodiscard]] std::optional<std::string> lost() const {
        const std::scoped_lock lock(mutex_);
        return lost_;
    }

    /// The first line that came, without its end; as much of it as came so far.
    [[nodiscard]] std::string first_line() const {
        const std::scoped_lock lock(mutex_);
        return first_line_.substr(0, first_line_.find_first_of("\r\n"));
    }

    void close() noexcept {
        {
            const std::scoped_lock lock(mutex_);
            give_up("it was closed");
        }
        context_.stop();
        if (thread_.joinable()) {
            thread_.join();
        }
        boost::system::error_code ignored;
        stream_.close(ignored);
    }

private:
    static constexpr std::size_t most_waiting = std::size_t{1} << 20U;  ///< bytes, 1 MiB
    static constexpr std::size_t most_received = std::size_t{1} << 20U; ///< then the other end has to wait
    static constexpr std::size_t most_of_a_line = 200;

    void give_up(std::string why) { // with mutex_ held
        if (!lost_) {
            lost_ = std::move(why);
            changed_.notify_all();
        }
    }

    /// Asio says "End of file" where nothing is a file.
    [[nodiscard]] static std::string reason_of(const boost::system::error_code& failure) {
        return failure == boost::asio::error::eof ? "the other end closed the connection" : failure.message();
    }

    void read_more() {
        stream_.async_read_some(boost::asio::buffer(chunk_),
                                [this](const boost::system::error_code& failure, std::size_t count) {
                                    const std::scoped_lock lock(mutex_);
                                    if (failure) {
                                        give_up(reason_of(failure));
                                        return;
                                    }
                                    received_.append(chunk_.data(), count);
                                    if (first_line_.size() < most_of_a_line) {
                                        first_line_.append(chunk_.data(), count);
                                    }
                                    changed_.notify_all();
                                    full_ = received_.size() >= most_received;
                                    if (!full_) {
                                        read_more();
                                    }
                                });
    }

    void write_more() {
        const std::scoped_lock lock(mutex_);
        if (!sending_.empty() || waiting_.empty() || lost_) {
            return;
        }
        std::swap(sending_, waiting_);
        boost::asio::async_write(stream_,
                                 boost::asio::buffer(sending_),
                                 [this](const boost::system::error_code& failure, std::size_t) {
                                     {
                                         const std::scoped_lock inner(mutex_);
                                         sending_.clear();
                                         if (failure) {
                                             give_up(reason_of(failure));
                                         }
                                     }
                                     write_more();
                                 });
    }

    boost::asio::io_context context_;
    boost::asio::executor_work_guard<boost::asio::io_context::executor_type> guard_{
        context_.get_executor()}; ///< it goes on while nothing is read
    Stream stream_;
    mutable std::mutex mutex_; ///< guards what follows
    std::condition_variable changed_;
    std::string received_, waiting_, sending_, first_line_;
    std::optional<std::string> lost_;
    bool full_ = false;              ///< nothing is read until what came is taken
    std::array<char, 4096> chunk_{}; ///< of the thread alone
    std::jthread thread_;
};

template <class Stream> class PumpLink {
public:
    /// `connect` opens the stream of a fresh pump and may throw.
    template <class Connect> void open(Connect&& connect) {
        auto fresh = std::make_shared<Pump<Stream>>();
        connect(fresh->stream());
        fresh->start();
        replace(std::move(fresh));
    }
    void write(std::string_view bytes) const {
        if (const auto pump = now()) {
            pump->write(bytes);
        }
    }
    void write_or_drop(std::string_view bytes) const {
        if (const auto pump = now()) {
            pump->write_or_drop(bytes);
        }
    }
    [[nodiscard]] std::string read() const {
        const auto pump = now();
        return pump ? pump->read() : std::string();
    }
    void wait(double seconds) const {
        if (const auto pump = now()) {
            pump->wait(seconds);
        } else {
            std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
        }
    }
    [[nodiscard]] std::optional<std::string> lost() const {
        const auto pump = now();
        return pump ? pump->lost() : std::optional<std::string>("the port is not open");
    }
    [[nodiscard]] std::string first_line() const {
        const auto pump = now();
        return pump ? pump->first_line() : std::string();
    }
    void close() noexcept {
        if (const auto pump = now()) {
            pump->close();
        }
    }

private:
    [[nodiscard]] std::shared_ptr<Pump<Stream>> now() const {
        const std::scoped_lock lock(mutex_);
        return pump_;
    }
    void replace(std::shared_ptr<Pump<Stream>> fresh) {
        const std::scoped_lock lock(mutex_);
        std::swap(pump_, fresh);
    }

    mutable std::mutex mutex_;
    std::shared_ptr<Pump<Stream>> pump_; ///< null: never opened
};

} // namespace millwright::links::internal
