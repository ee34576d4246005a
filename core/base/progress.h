// How long work tells where it is and learns that it is no longer wanted.
#pragma once

#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <string_view>

namespace millwright {

/// Passed by value or reference into anything that can take 50 ms. Copies speak to the same listener.
/// All members may be called from any thread; the listener is called by one thread at a time.
class Progress {
public:
    struct Report {
        double fraction = 0.0; ///< of the whole work, 0 to 1, never falling
        std::string text;      ///< what is being done, for people
    };
    using Listener = std::function<void(const Report&)>;

    /// Reports to no one and is never cancelled.
    Progress();
    Progress(Listener listener, std::stop_token stop);

    /// The stretch `from` to `to` of this progress, as a progress from 0 to 1 of its own.
    [[nodiscard]] Progress part(double from, double to) const;

    /// `fraction` of this part is done. `text` replaces what is being shown unless it is empty.
    void report(double fraction, std::string_view text = {}) const;

    [[nodiscard]] bool cancelled() const;

    /// Throws Cancelled if the user said stop. To be called every 20 ms or less.
    void check() const;

private:
    struct Shared;
    std::shared_ptr<Shared> shared_;
    double from_ = 0.0;
    double to_ = 1.0;
};

} // namespace millwright
