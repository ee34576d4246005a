// A link with faults: everything goes through, but for what a FaultSpec makes go wrong on the way.
#pragma once

#include "core/base/clock.h"
#include "core/links/faults.h"
#include "core/links/link.h"

#include <mutex>

namespace millwright::links {

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
