// A link with faults: everything goes through, but for what a FaultSpec makes go wrong on the way.
#pragma once

#include "core/base/clock.h"
#include "core/links/link.h"

#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <random>
#include <string>
#include <string_view>

namespace millwright::links {

// What can go wrong on a wire, made to happen: for tests, and for trying out how a job ends when it does.
// The same seed gives the same faults.

/// Probabilities are those of a byte, or of an `ok` for `lost_ok`.
struct FaultSpec {
    double drop = 0.0;
    double garble = 0.0;
    double duplicate = 0.0;
    double lost_ok = 0.0;
    double delay = 0.0;                           ///< at most, s
    std::optional<std::int64_t> disconnect{};     ///< after so many bytes
    std::optional<std::int64_t> stall{};          ///< after so many bytes nothing passes any more
    std::optional<std::int64_t> reset{}, alarm{}; ///< of the controller, after so many bytes; for emulators
    std::optional<std::int64_t> emergency_stop{}; ///< pressed after so many bytes; for emulators
    bool toward_host = true;
    bool toward_controller = true;
    std::uint64_t seed = 1;

    friend bool operator==(const FaultSpec&, const FaultSpec&) = default;
};

/// Reads
/// `drop=P,garble=P,duplicate=P,lost-ok=P,delay=S,disconnect=N,stall=N,reset=N,alarm=N,estop=N,toward=host,
/// seed=N`, each word at most once and all of them optional; `toward` is host, controller or both. Throws
/// Error naming the word at fault.
[[nodiscard]] FaultSpec read_fault_spec(std::string_view text);

enum class WireEnd { host, controller };

/// One direction of a wire, toward one end. Time is the caller's, s.
class FaultyWire {
public:
    FaultyWire(const FaultSpec& spec, WireEnd toward);

    void send(std::string_view bytes, double now);
    /// What has arrived by `now`.
    [[nodiscard]] std::string arrived(double now);
    /// When the next byte arrives; nothing if none is under way.
    [[nodiscard]] std::optional<double> next_arrival() const;
    [[nodiscard]] bool disconnected() const;
    /// Bytes that were sent.
    [[nodiscard]] std::int64_t sent() const { return sent_; }
    /// Bytes that were changed, added or lost.
    [[nodiscard]] std::int64_t faults() const { return faults_; }

private:
    struct Parcel {
        double time = 0.0;
        std::string bytes;
    };

    [[nodiscard]] bool happens(double probability);
    [[nodiscard]] double uniform();
    void pass(char byte, std::string& through);
    [[nodiscard]] std::string without_lost_acks(std::string_view bytes);

    FaultSpec spec_;
    bool on_ = true; ///< whether faults happen in this direction
    std::mt19937_64 random_;
    std::deque<Parcel> under_way_;
    std::int64_t sent_ = 0;
    std::int64_t faults_ = 0;
};

/// Wrapped around the controller's own end, its host being whoever is on the other side.
class FaultLink final : public Link {
public:
    /// `end` is where this link is used: what is written goes to the other end. `clock` must outlive it.
    FaultLink(std::unique_ptr<Link> inner, const FaultSpec& spec, WireEnd end, const Clock& clock);

    [[nodiscard]] std::string name() const override { return inner_->name(); }
    void open() override;
    void write(std::string_view bytes) override;
    [[nodiscard]] std::string read() override;
    void wait(double seconds) override;
    [[nodiscard]] std::optional<std::string> lost() const override;
    void close() noexcept override;
    [[nodiscard]] int visits() const override { return inner_->visits(); }

    /// Bytes that were sent in either direction.
    [[nodiscard]] std::int64_t passed() const;
    [[nodiscard]] Link& inner() { return *inner_; }

private:
    void move_bytes();

    std::unique_ptr<Link> inner_;
    FaultSpec spec_;
    WireEnd end_;
    const Clock& clock_;
    mutable std::mutex mutex_; ///< guards what follows
    FaultyWire out_, in_;
};

} // namespace millwright::links
