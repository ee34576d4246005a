// The bytes of a file as they were when it was opened, mapped into memory. They stand in a nameless copy of
// their own, so that a program that writes to the file meanwhile changes nothing here and can take no pages
// away; what is not looked at needs no memory.
#pragma once

#include "core/base/progress.h"

#include <cstddef>
#include <filesystem>
#include <string_view>

namespace millwright {

/// Bytes of the largest file that is read so: 50 million lines of G-code.
inline constexpr std::size_t largest_snapshot = std::size_t{2} << 30U;
/// The same of a device or a pipe, of unknown length.
inline constexpr std::size_t largest_stream = std::size_t{256} << 20U;

class FileSnapshot {
public:
    /// No bytes.
    FileSnapshot() = default;
    /// The copy lies in the system's folder for temporary files. Throws Error with the file and the system's
    /// reason, or where it has more than `most` bytes, or does not end before; or Cancelled.
    explicit FileSnapshot(const std::filesystem::path& file,
                          const Progress& progress = Progress(),
                          std::size_t most = largest_snapshot);
    FileSnapshot(FileSnapshot&& other) noexcept;
    FileSnapshot& operator=(FileSnapshot&& other) noexcept;
    ~FileSnapshot();

    [[nodiscard]] std::string_view text() const { return {data_, size_}; }

private:
    const char* data_ = nullptr;
    std::size_t size_ = 0;
};

} // namespace millwright
