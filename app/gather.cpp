#include "app/gather.h"

#include <chrono>
#include <mutex>
#include <optional>
#include <queue>
#include <thread>
#include <utility>

namespace millwright::app {

namespace {

/// What rank 0 says to itself, from the thread of its work.
class Mailbox {
public:
    void put(std::string message) {
        const std::scoped_lock lock(turn_);
        messages_.push(std::move(message));
    }
    std::optional<std::string> take() {
        const std::scoped_lock lock(turn_);
        if (messages_.empty()) {
            return std::nullopt;
        }
        std::string message = std::move(messages_.front());
        messages_.pop();
        return message;
    }

private:
    std::mutex turn_;
    std::queue<std::string> messages_;
};

/// Whether there was anything.
bool hear(Mailbox& mailbox, const Ranks& ranks, const GatheredWork& work) {
    bool silent = true;
    while (const auto message = mailbox.take()) {
        work.heard(0, *message);
        silent = false;
    }
    while (const auto message = ranks.heard()) {
        work.heard(message->from, message->text);
        silent = false;
    }
    return !silent;
}

} // namespace

bool gather(const Ranks& ranks, const GatheredWork& work, const Progress& progress) {
    // A rank that is gone says nothing more; mpirun then stops the others, and kills them a second later.
    // Until then it has to be said who is gone, and what came has to be written.
    constexpr std::chrono::milliseconds patience_when_stopped{250};
    constexpr std::chrono::milliseconds nap{5};
    Mailbox mailbox;
    std::stop_source stop;
    std::jthread thread(
        [&] { work.own([&](const std::string& message) { mailbox.put(message); }, stop.get_token()); });
    std::optional<std::chrono::steady_clock::time_point> stopped;
    while (!work.over()) {
        const bool heard = hear(mailbox, ranks, work);
        if (progress.cancelled() && !stopped) {
            stopped = std::chrono::steady_clock::now();
            stop.request_stop();
        }
        if (stopped && std::chrono::steady_clock::now() - *stopped > patience_when_stopped) {
            work.given_up();
            break;
        }
        if (!heard) {
            std::this_thread::sleep_for(nap);
        }
    }
    thread.join();
    hear(mailbox, ranks, work);
    return !stopped;
}

} // namespace millwright::app
