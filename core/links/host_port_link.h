// Characters through the host port of a PMAC on the ISA bus: polled, each one only when the card is ready.
// Registers after Delta Tau, PMAC User Manual; the bits of the status after Saengsasri, Nittayachin 1996
// (KMITL).
#pragma once

#include "core/base/clock.h"
#include "core/links/link.h"

#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>

namespace millwright::links {

// Byte registers of a card in the computer's I/O space, as those on the ISA bus had them.

constexpr std::uint8_t no_card = 0xFF; ///< what a bus without a card reads

class PortRegisters {
public:
    virtual ~PortRegisters() = default;
    /// For people: "isa:0x210".
    [[nodiscard]] virtual std::string name() const = 0;
    /// Throws Error if they cannot be reached.
    virtual void open() = 0;
    virtual void close() noexcept = 0;
    /// `offset` from the first register. All ones where no card is.
    [[nodiscard]] virtual std::uint8_t read(int offset) = 0;
    virtual void write(int offset, std::uint8_t value) = 0;
};

/// Those of this computer from `base` on, through /dev/port, which takes root. Linux alone.
[[nodiscard]] std::unique_ptr<PortRegisters> io_ports(int base);

class HostPortLink final : public Link {
public:
    explicit HostPortLink(std::unique_ptr<PortRegisters> registers,
                          std::unique_ptr<Clock> clock = std::make_unique<SteadyClock>());

    [[nodiscard]] std::string name() const override { return registers_->name(); }
    /// Throws Error where no card is.
    void open() override;
    void write(std::string_view bytes) override;
    [[nodiscard]] std::string read() override;
    void wait(double seconds) override;
    /// No card, or one that took no character for half a second: none is dropped in silence.
    [[nodiscard]] std::optional<std::string> lost() const override;
    void close() noexcept override;

private:
    void pump();

    std::unique_ptr<PortRegisters> registers_;
    std::unique_ptr<Clock> clock_;
    mutable std::mutex mutex_; ///< guards what follows, and the registers
    std::deque<char> out_;
    std::string in_;
    double taken_at_ = 0.0; ///< when the card was last seen to take a character, or nothing waited
    std::optional<std::string> lost_ = "the port is not open";
};

} // namespace millwright::links
