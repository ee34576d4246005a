// A lock for a thread that works in turns and others that ask in between.
#pragma once

#include <mutex>

namespace millwright {

/// Whoever lets it go and wants it again waits behind a thread that has been waiting. A std::mutex promises
/// no such thing: a thread that works in a loop and lets go for an instant alone may keep the others out for
/// seconds on a busy computer, and one of them may be a person's stop.
///
/// Not recursive. A Lockable of the standard.
class FairMutex {
public:
    void lock() {
        const std::scoped_lock next(next_);
        turn_.lock();
    }
    void unlock() { turn_.unlock(); }
    [[nodiscard]] bool try_lock() {
        const std::unique_lock next(next_, std::try_to_lock);
        return next.owns_lock() && turn_.try_lock();
    }

private:
    std::mutex next_; ///< held by the one that has the next turn, while it waits
    std::mutex turn_;
};

} // namespace millwright
