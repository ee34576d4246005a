#include "app/studies/mpi_gather.h"

#include <fmt/format.h>

#include <chrono>
#include <mutex>
#include <optional>
#include <queue>
#include <thread>
#include <utility>

namespace millwright::app {

namespace {

using GatherClock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds nap{5};

/// From the thread of the work to the one that speaks with the others.
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

void pass_on(Mailbox& mailbox, const Ranks& ranks) {
    while (const auto message = mailbox.take()) {
        ranks.tell(*message);
    }
}

} // namespace

std::string shared_work(std::size_t count, std::string_view thing, const Ranks& ranks) {
    const std::string work = fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
    return ranks.size() == 1 ? work : fmt::format("{} on {} ranks", work, ranks.size());
}

bool mpi_gather(const Ranks& ranks, const GatheredWork& work, const Progress& progress) {
    // A rank that is gone says nothing more; mpirun then stops the others, and kills them a second later.
    // Until then it has to be said who is gone, and what came has to be written.
    constexpr std::chrono::milliseconds patience_when_stopped{250};
    Mailbox mailbox;
    std::stop_source stop;
    std::jthread thread(
        [&] { work.own([&](const std::string& message) { mailbox.put(message); }, stop.get_token()); });
    std::optional<GatherClock::time_point> stopped;
    while (!work.over()) {
        const bool heard = hear(mailbox, ranks, work);
        if (progress.cancelled() && !stopped) {
            stopped = GatherClock::now();
            stop.request_stop();
            ranks.let_go(); // so that they know who tells of it
        }
        if (stopped && GatherClock::now() - *stopped > patience_when_stopped) {
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

void mpi_help(const Ranks& ranks, const HelpingWork& work, const std::stop_token& stop) {
    // mpirun kills a second after it said stop; rank 0 answers at once, on a busy computer a little later.
    constexpr std::chrono::milliseconds patience_with_rank_0{500};
    Mailbox mailbox;
    std::jthread thread;
    std::optional<GatherClock::time_point> stopped;
    while (true) {
        pass_on(mailbox, ranks);
        if (const auto word = ranks.heard()) {
            if (word->text.empty()) {
                break;
            }
            thread = std::jthread([&, asked = word->text](const std::stop_token& own_stop) {
                work.own(
                    asked, [&](const std::string& message) { mailbox.put(message); }, own_stop);
            });
        }
        if (stop.stop_requested() && !stopped) {
            stopped = GatherClock::now();
            thread.request_stop();
        }
        if (stopped && GatherClock::now() - *stopped > patience_with_rank_0) {
            work.deserted();
            break;
        }
        std::this_thread::sleep_for(nap);
    }
    thread.request_stop();
    if (thread.joinable()) {
        thread.join();
    }
    pass_on(mailbox, ranks);
}

} // namespace millwright::app
