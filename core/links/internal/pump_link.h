// A Link over a Boost.Asio stream: everything but how it is opened.
#pragma once

#include "core/links/internal/pump.h"
#include "core/links/link.h"

#include <memory>

namespace millwright::links::internal {

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
