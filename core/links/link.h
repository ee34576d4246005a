// A way for bytes to a controller and back: a serial port, a TCP connection, or the other end of one. Knows
// nothing of what the bytes mean.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace millwright::links {

/// Every member may be called from any thread.
class Link {
public:
    virtual ~Link() = default;
    /// Where it leads, for people: "/dev/ttyUSB0", "tcp:127.0.0.1:2300".
    [[nodiscard]] virtual std::string name() const = 0;

    /// Throws Error with name and reason if there is nothing at the other end. Opening an open link drops
    /// what came before and starts afresh.
    virtual void open() = 0;
    /// Hands over bytes and returns at once; they are sent in order. Bytes for a lost link are dropped.
    virtual void write(std::string_view bytes) = 0;
    /// Takes everything that has come, in order; never waits.
    [[nodiscard]] virtual std::string read() = 0;
    /// Returns as soon as there is something to read or the link is lost, at the latest after `seconds`.
    virtual void wait(double seconds) = 0;
    /// Why nothing can be sent or received any more; nothing while the link stands.
    [[nodiscard]] virtual std::optional<std::string> lost() const = 0;
    virtual void close() noexcept = 0;
    /// Bytes that it carries per second, where that is set; nothing: not known.
    [[nodiscard]] virtual std::optional<double> rate() const { return std::nullopt; }
    /// How many programs have connected to it so far, where it listens and the system tells; else 0.
    [[nodiscard]] virtual int visits() const { return 0; }
};

/// A sentence for people of what Link::lost() says: "the link was lost: WHY", or that it was never ours.
[[nodiscard]] std::string loss_sentence(const std::string& why);

/// Begins Link::lost() where another client holds the port.
inline constexpr std::string_view held_by_another = "the port is held by another client";

/// Throws Error where `bytes`, which go every `period` s, take longer than that over `link`: they would come
/// ever later, and a hold after them.
void expect_carried(const Link& link, std::size_t bytes, double period);

/// The link that `address` names: `tcp:HOST:PORT`, `file:PATH` (only written to), `isa:0x210` (a PMAC's host
/// port), else a serial port as parse_serial_address() reads it (115200 baud, 8N1 where nothing is said). Not
/// opened yet. Throws Error if it is no address.
[[nodiscard]] std::unique_ptr<Link> make_link(const std::string& address);

} // namespace millwright::links
