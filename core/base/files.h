// Whole files in and out. A write either replaces the file completely or leaves the old one untouched.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace millwright {

/// The bytes of `file`. Throws Error with the file and the system's reason.
[[nodiscard]] std::string read_file(const std::filesystem::path& file);

/// Writes beside `file` and renames over it, so that a failed write leaves the old file as it was. A symbolic
/// link keeps pointing: its target is replaced. What is no file - a device, a pipe - is written through.
/// Throws Error with the file and the system's reason.
void write_file(const std::filesystem::path& file, std::string_view bytes);

/// The same of a file that comes piece by piece and need not be in memory as a whole.
class FileWriter {
public:
    /// Throws Error with the file and the system's reason, as all that follow.
    explicit FileWriter(std::filesystem::path file);
    FileWriter(const FileWriter&) = delete;
    FileWriter& operator=(const FileWriter&) = delete;
    ~FileWriter(); ///< leaves the old file as it was unless closed; what is no file has what was written

    void write(std::string_view bytes);
    void close(); ///< renames over the old file; nothing may be written then

private:
    [[nodiscard]] bool writes_through() const { return draft_.empty(); }
    void finish_draft();
    [[noreturn]] void fail() const;

    std::filesystem::path file_; ///< behind a symbolic link its target
    std::string draft_;          ///< empty: `file_` is no file, and is written to directly
    int handle_ = -1;
};

/// Makes `folder` and its parents where missing. Throws Error if it cannot be made or is not a folder.
void make_folder(const std::filesystem::path& folder);

} // namespace millwright
