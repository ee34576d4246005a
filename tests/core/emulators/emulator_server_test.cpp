// The time of an emulated controller that waits for its host, by a clock that the test winds.
#include "core/emulators/emulator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

namespace millwright::emulators {
namespace {

class WoundClock final : public Clock {
public:
    [[nodiscard]] double now() const override { return now_; }
    void wait(double seconds) override { now_ = now_ + seconds; }

private:
    std::atomic<double> now_ = 0.0;
};

/// Counts how often it was looked at.
class WordLink final : public links::Link {
public:
    explicit WordLink(std::atomic<int>& reads) : reads_(reads) {}
    [[nodiscard]] std::string name() const override { return "test"; }
    void open() override {}
    void write(std::string_view) override {}
    [[nodiscard]] std::string read() override {
        const std::scoped_lock lock(mutex_);
        ++reads_;
        return std::exchange(words_, {});
    }
    void wait(double) override { std::this_thread::yield(); }
    [[nodiscard]] std::optional<std::string> lost() const override { return {}; }
    void close() noexcept override {}
    void say(std::string_view word) {
        const std::scoped_lock lock(mutex_);
        words_ += word;
    }

private:
    std::atomic<int>& reads_;
    std::mutex mutex_;
    std::string words_;
};

/// Its time, and the longest that passed between two words.
class TimedEmulator final : public Emulator {
public:
    void receive(std::string_view bytes) override { silence_ = bytes.empty() ? silence_ : 0.0; }
    void advance(double seconds) override {
        time += seconds;
        silence_ += seconds;
        longest_silence = std::max(longest_silence, silence_);
    }
    [[nodiscard]] std::string take_output() override { return {}; }
    [[nodiscard]] bool moving() const override { return true; }
    void raise_alarm() override {}
    void emergency_stop() override {}
    void power_cycle() override {}

    double time = 0.0, longest_silence = 0.0;

private:
    double silence_ = 0.0;
};

struct EmulatorServerBench {
    static constexpr double silence = 0.01;
    std::atomic<int> reads = 0; // outlives the server's thread
    WoundClock clock;
    WordLink* link = nullptr;
    TimedEmulator* emulator = nullptr;
    std::unique_ptr<EmulatorServer> server;

    EmulatorServerBench() {
        std::vector<std::unique_ptr<links::Link>> links;
        links.push_back(std::make_unique<WordLink>(reads));
        link = static_cast<WordLink*>(links.front().get());
        auto made = std::make_unique<TimedEmulator>();
        emulator = made.get();
        server = std::make_unique<EmulatorServer>(std::move(links), clock, std::move(made));
        server->wait_for_host(silence);
        settle();
    }
    /// Until what is said and the time that passed were looked at.
    void settle() const {
        for (const int before = reads; reads < before + 3;) {
            std::this_thread::yield();
        }
    }
    void pass(int ms) {
        for (int n = 0; n < ms; ++n) {
            clock.wait(1e-3);
            settle();
        }
    }
    [[nodiscard]] std::pair<double, double> time_and_silence() const {
        return server->with_emulator(
            [&](Emulator&) { return std::pair(emulator->time, emulator->longest_silence); });
    }
};

// As the PMAC driver polls: a line every 20 ms, and its end as soon as the card has sent the line's sum.
TEST(EmulatorServer, RunsAtItsTrueSpeedForAHostThatAsksEveryTwoOfItsSilences) {
    EmulatorServerBench bench;
    for (int poll = 0; poll < 50; ++poll) {
        bench.link->say("#1P\x0E");
        bench.pass(1);
        bench.link->say("\r");
        bench.pass(19);
    }
    const auto [time, silence] = bench.time_and_silence();
    EXPECT_GT(time, 0.97);
    EXPECT_LT(time, 1.0 + 1e-9);
    EXPECT_LT(silence, EmulatorServerBench::silence + 1e-9);
}

TEST(EmulatorServer, StandsStillForASilentHostAndDoesNotMakeUpForThat) {
    EmulatorServerBench bench;
    bench.pass(3000);
    EXPECT_LT(bench.time_and_silence().first, EmulatorServerBench::silence + 1e-9);
    for (int word = 0; word < 100; ++word) {
        bench.link->say("?");
        bench.pass(1);
    }
    const auto [time, silence] = bench.time_and_silence();
    EXPECT_LT(time, EmulatorServerBench::silence + 0.05 + 0.1 + 1e-9); // no more than one short wait
    EXPECT_LT(silence, EmulatorServerBench::silence + 1e-9);
}

} // namespace
} // namespace millwright::emulators
