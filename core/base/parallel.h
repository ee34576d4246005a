// The only door to threads for computing. Work is cut by a fixed size, never by the number of threads, and
// each piece writes its own slots, so results are the same bytes on any number of threads.
#pragma once

#include <cstddef>
#include <functional>

namespace millwright {

/// Calls `body(i)` for every i in [0, count), `chunk` indices in order by one thread. The body writes only
/// what belongs to i and reads only what no other thread writes. Rethrows the exception of the lowest chunk
/// that threw.
void parallel_for(std::ptrdiff_t count,
                  std::ptrdiff_t chunk,
                  const std::function<void(std::ptrdiff_t)>& body);

/// The number of threads that parallel_for uses; 0 puts the machine's own number back.
void set_thread_count(int threads);
[[nodiscard]] int thread_count();

} // namespace millwright
