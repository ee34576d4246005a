// What memory the computer has left for large work.
#pragma once

#include <cstddef>
#include <optional>

namespace millwright {

/// Bytes that can be taken without any other being moved to disk; nothing where the system does not tell.
[[nodiscard]] std::optional<std::size_t> free_memory();

} // namespace millwright
