// Reading from links whose bytes take their time.
#pragma once

#include "core/links/link.h"

#include <chrono>
#include <thread>

namespace millwright::test {

/// Until `done`, at the longest for a time that only a broken program needs.
template <class Done> void wait_until(const Done& done) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (!done() && std::chrono::steady_clock::now() < end) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

/// The next `count` bytes, or fewer if they never come.
inline std::string read_bytes(links::Link& link, std::size_t count) {
    std::string bytes;
    wait_until([&] {
        bytes += link.read();
        return bytes.size() >= count;
    });
    return bytes;
}

} // namespace millwright::test
