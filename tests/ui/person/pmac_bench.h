// An emulated PMAC with the motors of an arm in real time at a TCP port, for a person to connect to.
#pragma once

#include "core/base/units.h"
#include "core/emulators/emulator.h"
#include "core/links/tcp.h"
#include "core/pmac/driver/pmac_settings.h"
#include "core/pmac/emulator/pmac_emulator.h"

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace millwright::test {

/// A link whose plug can be pulled: nothing comes through, and neither side is notified.
class Plug final : public links::Link {
public:
    explicit Plug(std::unique_ptr<links::Link> inner) : inner_(std::move(inner)) {}

    [[nodiscard]] std::string name() const override { return inner_->name(); }
    void open() override { inner_->open(); }
    void write(std::string_view bytes) override { inner_->write(out ? std::string_view() : bytes); }
    [[nodiscard]] std::string read() override {
        std::string bytes = inner_->read();
        return out ? std::string() : bytes;
    }
    void wait(double seconds) override { inner_->wait(seconds); }
    [[nodiscard]] std::optional<std::string> lost() const override { return inner_->lost(); }
    void close() noexcept override { inner_->close(); }

    std::atomic<bool> out = false;

private:
    std::unique_ptr<links::Link> inner_;
};

class PmacBench {
public:
    /// Motors 1 to 4 are active, with the factory's protections; they have no power.
    PmacBench() {
        auto server = std::make_unique<links::TcpServer>(0);
        server->open();
        address_ = "tcp:127.0.0.1:" + std::to_string(server->port());
        auto card = std::make_unique<pmac::PmacEmulator>();
        card_ = card.get();
        const std::string setup = "I100=1\rI200=1\rI300=1\rI400=1\r"
                                  "I902=10\rI907=10\rI912=10\rI917=10\rI123=10\rI223=10\rI323=10\rI423=10\r"
                                  "#1->120X\r#2->222Y\r#3->150Z\r#4->150A\r";
        card->receive(setup);
        (void)card->take_output();
        std::vector<std::unique_ptr<links::Link>> links;
        auto plug = std::make_unique<Plug>(std::move(server));
        plug_ = plug.get();
        links.push_back(std::move(plug));
        server_ = std::make_unique<emulators::EmulatorServer>(std::move(links), clock_, std::move(card));
        server_->wait_for_host(longest_silence);
    }

    [[nodiscard]] const std::string& address() const { return address_; }
    /// Of a motor from 1, as its encoder tells.
    [[nodiscard]] double degrees(int motor) {
        const double scale = pmac::arm_settings().axes[static_cast<std::size_t>(motor) - 1].counts_per_degree;
        return ask([&] { return card_->position(motor) / scale; });
    }
    [[nodiscard]] bool powered() {
        return ask(
            [&] { return card_->enabled(1) && card_->enabled(2) && card_->enabled(3) && card_->enabled(4); });
    }
    [[nodiscard]] bool any_power() {
        return ask(
            [&] { return card_->enabled(1) || card_->enabled(2) || card_->enabled(3) || card_->enabled(4); });
    }
    [[nodiscard]] bool moving() {
        return ask([&] { return card_->moving(); });
    }
    /// The card's own time, s: now, and when anything moved last.
    [[nodiscard]] double time() {
        return ask([&] { return card_->time(); });
    }
    [[nodiscard]] double last_motion() {
        return ask([&] { return card_->last_motion(); });
    }
    /// Card and cable are gone.
    void vanish() {
        plug_ = nullptr;
        server_.reset();
    }
    /// The cable is pulled, or in again; the card lives on.
    void pull_plug(bool out = true) {
        plug_->out = out;
        server_->wait_for_host(out ? std::nullopt : std::optional(longest_silence));
    }

private:
    static constexpr double longest_silence = 0.01; // s: four words come within the 50 ms that the card bears

    template <class Question> std::invoke_result_t<Question> ask(Question&& question) {
        return server_->with_emulator([&](emulators::Emulator&) { return question(); });
    }

    SteadyClock clock_;
    std::string address_;
    pmac::PmacEmulator* card_ = nullptr; ///< lives in the server
    Plug* plug_ = nullptr;               ///< there, too
    std::unique_ptr<emulators::EmulatorServer> server_;
};

} // namespace millwright::test
