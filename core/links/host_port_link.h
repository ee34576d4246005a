// Characters through the host port of a PMAC on the ISA bus: polled, each one only when the card is ready.
// Registers after Delta Tau, PMAC User Manual; the bits of the status after Saengsasri, Nittayachin 1996
// (KMITL).
#pragma once

#include "core/base/clock.h"
#include "core/links/link.h"
#include "core/links/port_registers.h"

#include <deque>
#include <memory>
#include <mutex>
#include <string>

namespace millwright::links {

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
