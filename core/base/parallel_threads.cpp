#include "core/base/error.h"
#include "core/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>
#include <vector>

namespace millwright {

namespace {

std::atomic<int>& wanted_threads() {
    static std::atomic<int> wanted{0};
    return wanted;
}

} // namespace

void set_thread_count(int threads) {
    expects(threads >= 0, "a number of threads is not negative");
    wanted_threads() = threads;
}

int thread_count() {
    const int wanted = wanted_threads();
    return wanted > 0 ? wanted : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

void parallel_for(std::ptrdiff_t count,
                  std::ptrdiff_t chunk,
                  const std::function<void(std::ptrdiff_t)>& body) {
    expects(count >= 0 && chunk > 0, "a loop has a count and a chunk size");
    const std::ptrdiff_t chunks = (count + chunk - 1) / chunk;
    std::vector<std::exception_ptr> thrown(static_cast<std::size_t>(chunks));
    std::atomic<std::ptrdiff_t> next{0};
    const auto work = [&] {
        for (std::ptrdiff_t c = next++; c < chunks; c = next++) {
            try {
                for (std::ptrdiff_t i = c * chunk; i < std::min(count, (c + 1) * chunk); ++i) {
                    body(i);
                }
            } catch (...) {
                thrown[static_cast<std::size_t>(c)] = std::current_exception();
            }
        }
    };
    {
        std::vector<std::jthread> threads;
        for (int t = 1; t < thread_count(); ++t) {
            threads.emplace_back(work);
        }
        work();
    }
    for (const std::exception_ptr& exception : thrown) {
        if (exception) {
            std::rethrow_exception(exception);
        }
    }
}

} // namespace millwright
