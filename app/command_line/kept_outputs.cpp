#include "app/command_line/kept_outputs.h"

#include "app/command_line/written_files.h"
#include "core/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <system_error>

namespace millwright::app {

namespace fs = std::filesystem;

namespace {

/// The file itself, which a link may lead to; empty unless it has bytes that could be lost.
fs::path file_to_lose(const fs::path& file) {
    std::error_code failure;
    const fs::path real = fs::canonical(file, failure);
    const bool has_bytes = !failure && fs::is_regular_file(real, failure) && fs::file_size(real, failure) > 0;
    return has_bytes && !failure ? real : fs::path();
}

bool is_untouched(const fs::path& file, const fs::path& name) {
    std::error_code failure;
    if (fs::equivalent(file, name, failure)) {
        return true;
    }
    return WrittenFiles::same_bytes(file, name);
}

} // namespace

fs::path kept_name(const fs::path& file) {
    std::error_code unknown;
    constexpr std::size_t longest_stem = 200; // bytes; a name may have 255
    const std::string stem = file.stem().string().substr(0, longest_stem);
    for (int n = 1;; ++n) {
        fs::path name = file.parent_path() / fmt::format("{}-kept-{}{}", stem, n, file.extension().string());
        if (!fs::exists(fs::symlink_status(name, unknown))) {
            return name;
        }
    }
}

bool named_twice(const fs::path& file, const fs::path& name) {
    std::error_code failure;
    fs::create_hard_link(file, name, failure);
    return !failure || fs::copy_file(file, name, failure);
}

void say_kept(const fs::path& file, const fs::path& name, bool was_written) {
    fmt::print(
        stderr,
        "millwright: {}\n",
        to_text(Diagnostic{{file, 0, 0, -1},
                           (was_written ? "was changed since Millwright wrote it; the changed file is now "
                                        : "was not written by Millwright; the old file is now ") +
                               name.filename().string(),
                           {}}));
}

void say_taken_away(const fs::path& file) {
    fmt::print(
        stderr,
        "millwright: {}\n",
        to_text(Diagnostic{{file, 0, 0, -1},
                           "was left by an earlier command, did not match the new files, and was removed",
                           {}}));
}

KeptOutputs::KeptOutputs(std::vector<fs::path> files) : files_(std::move(files)) {
    for (const fs::path& file : files_) {
        const fs::path real = file_to_lose(file);
        const WrittenFiles written;
        if (real.empty() || written.holds(real)) {
            continue;
        }
        fs::path name = kept_name(real);
        if (!named_twice(real, name)) {
            name.clear(); // nothing can be written there either
        }
        kept_.push_back({real, std::move(name), written.knows(real)});
    }
}

KeptOutputs::~KeptOutputs() {
    std::vector<fs::path> not_ours;
    for (const auto& [file, name, was_written] : kept_) {
        if (name.empty()) {
            not_ours.push_back(file);
        } else if (is_untouched(file, name)) {
            std::error_code ignored;
            fs::remove(name, ignored);
            not_ours.push_back(file);
        } else {
            say_kept(file, name, was_written);
        }
    }
    std::vector<fs::path> written;
    for (const fs::path& file : files_) {
        fs::path real = file_to_lose(file);
        if (!real.empty() && std::ranges::find(not_ours, real) == not_ours.end()) {
            written.push_back(std::move(real));
        }
    }
    if (!written.empty()) {
        WrittenFiles().add(written);
    }
}

} // namespace millwright::app
