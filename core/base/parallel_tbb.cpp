#include "core/base/error.h"
#include "core/base/parallel.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <map>
#include <vector>

namespace millwright {

namespace {

std::atomic<int>& wanted_threads() {
    static std::atomic<int> wanted{0};
    return wanted;
}

/// Kept as long as the thread that asks, one for each number of threads: oneTBB 2021.8 never gives back what
/// an arena takes (7 kB), and is the slower the more there have been.
tbb::task_arena& arena_of_this_thread(int threads) {
    thread_local std::map<int, tbb::task_arena> arenas;
    return arenas.try_emplace(threads, threads).first->second;
}

} // namespace

void set_thread_count(int threads) {
    expects(threads >= 0, "a number of threads is not negative");
    wanted_threads() = threads;
}

int thread_count() {
    const int wanted = wanted_threads();
    return wanted > 0 ? wanted : tbb::info::default_concurrency();
}

void parallel_for(std::ptrdiff_t count,
                  std::ptrdiff_t chunk,
                  const std::function<void(std::ptrdiff_t)>& body) {
    expects(count >= 0 && chunk > 0, "a loop has a count and a chunk size");
    const std::ptrdiff_t chunks = (count + chunk - 1) / chunk;
    std::vector<std::exception_ptr> thrown(static_cast<std::size_t>(chunks));
    const auto run_chunk = [&](std::ptrdiff_t c) {
        try {
            for (std::ptrdiff_t i = c * chunk; i < std::min(count, (c + 1) * chunk); ++i) {
                body(i);
            }
        } catch (...) {
            thrown[static_cast<std::size_t>(c)] = std::current_exception();
        }
    };
    const int threads = thread_count();
    const tbb::global_control allow(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    // Isolated: a loop inside a loop waits for its own chunks alone.
    arena_of_this_thread(threads).execute([&] {
        tbb::this_task_arena::isolate(
            [&] { tbb::parallel_for(std::ptrdiff_t{0}, chunks, run_chunk, tbb::simple_partitioner{}); });
    });
    for (const std::exception_ptr& exception : thrown) {
        if (exception) {
            std::rethrow_exception(exception);
        }
    }
}

} // namespace millwright
