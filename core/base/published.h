// The newest of what a thread has worked out, for other threads to look at.
#pragma once

#include "core/base/progress.h"

#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>

namespace millwright {

/// `Value` has a member `revision`, which grows with every publication. All members may be called from any
/// thread.
template <class Value> class Published {
public:
    /// Null before the first. What it leads to never changes.
    [[nodiscard]] std::shared_ptr<const Value> latest() const {
        const std::scoped_lock lock(mutex_);
        return latest_;
    }
    /// Takes the place of the one before.
    void publish(Value value) {
        const std::scoped_lock lock(mutex_);
        put(std::move(value));
    }
    /// The same, but nothing of what is no longer wanted. Throws Cancelled.
    void publish(Value value, const Progress& progress) {
        const std::scoped_lock lock(mutex_);
        progress.check();
        put(std::move(value));
    }
    void clear() {
        const std::scoped_lock lock(mutex_);
        latest_.reset();
    }

private:
    void put(Value value) {
        value.revision = ++revision_;
        latest_ = std::make_shared<const Value>(std::move(value));
    }

    mutable std::mutex mutex_; ///< guards what follows
    std::shared_ptr<const Value> latest_;
    std::uint64_t revision_ = 0;
};

} // namespace millwright
