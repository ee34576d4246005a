// Whole files in and out. A write either replaces the file completely or leaves the old one untouched.
#pragma once

#include "core/base/draft.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace millwright {

/// Bytes of the largest file that is read as a whole.
inline constexpr std::size_t largest_file = std::size_t{1} << 30U;

/// The bytes of `file`. Throws Error with the file and the system's reason, or where it has more than `most`
/// bytes, or does not end before.
[[nodiscard]] std::string read_file(const std::filesystem::path& file, std::size_t most = largest_file);

/// The sentence for a file of more than `most` bytes.
[[nodiscard]] std::string too_large_text(std::size_t most);

/// Writes a Draft of `file`, so that a failed write leaves the old file as it was. A symbolic link keeps
/// pointing: its target is replaced. What is no file - a device, a pipe - is written through. Throws Error
/// with the file and the system's reason.
void write_file(const std::filesystem::path& file, std::string_view bytes, Privacy privacy = Privacy::shared);

/// The same of a file that comes piece by piece and need not be in memory as a whole.
class FileWriter {
public:
    /// Throws Error with the file and the system's reason, as all that follow.
    explicit FileWriter(const std::filesystem::path& file, Privacy privacy = Privacy::shared);
    FileWriter(const FileWriter&) = delete;
    FileWriter& operator=(const FileWriter&) = delete;
    ~FileWriter(); ///< leaves the old file as it was unless closed; what is no file has what was written

    void write(std::string_view bytes);
    void close(); ///< puts it in the place of the old file; nothing may be written then

private:
    [[noreturn]] void fail() const;

    std::filesystem::path file_;
    std::unique_ptr<Draft> draft_; ///< null: `file_` is no file, and is written to directly
    int handle_ = -1;              ///< then
};

/// Makes `folder` and its parents where missing. Throws Error if it cannot be made or is not a folder.
void make_folder(const std::filesystem::path& folder);

} // namespace millwright
