// What a benchmark opens: a file that is written once and gone when the benchmark is over.
#pragma once

#include "core/base/files.h"

#include <unistd.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

namespace millwright::bench {

class WrittenFile {
public:
    /// `name` with this program's number before it, in the folder for such things.
    WrittenFile(std::string_view name, std::string_view text)
        : path_(std::filesystem::temp_directory_path() /
                (std::to_string(::getpid()) + "-" + std::string(name))) {
        write_file(path_, text);
    }
    WrittenFile(const WrittenFile&) = delete;
    WrittenFile& operator=(const WrittenFile&) = delete;
    ~WrittenFile() {
        std::error_code gone;
        std::filesystem::remove(path_, gone);
    }

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

} // namespace millwright::bench
