// Byte registers of a card in the computer's I/O space, as those on the ISA bus had them.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace millwright::links {

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

} // namespace millwright::links
