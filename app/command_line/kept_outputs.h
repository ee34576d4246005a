// Files that a command would replace and that Millwright has not written: they stay under another name.
#pragma once

#include <filesystem>
#include <utility>
#include <vector>

namespace millwright::app {

/// "program-kept-1.ngc", which is free.
[[nodiscard]] std::filesystem::path kept_name(const std::filesystem::path& file);

/// Gives `file` a second name, that of the same file or of a copy where files have but one. False if it
/// cannot have one.
[[nodiscard]] bool named_twice(const std::filesystem::path& file, const std::filesystem::path& name);

/// On standard error. `was_written`: a command has written `file` once.
void say_kept(const std::filesystem::path& file, const std::filesystem::path& name, bool was_written);

/// On standard error: of a file that no longer fits the others in its folder.
void say_taken_away(const std::filesystem::path& file);

/// While a command runs that writes `files`. At the end those that it replaced, and that were not as a
/// command had written them last, are there under another name, and what it wrote is remembered. A file that
/// it left alone stays what it was: of others, or ours.
class KeptOutputs {
public:
    explicit KeptOutputs(std::vector<std::filesystem::path> files);
    KeptOutputs(const KeptOutputs&) = delete;
    KeptOutputs& operator=(const KeptOutputs&) = delete;
    ~KeptOutputs();

private:
    std::vector<std::filesystem::path> files_;
    /// Of others, each with its second name; empty where it cannot have one.
    struct Kept {
        std::filesystem::path file, name;
        bool was_written = false; ///< a command has written it once
    };
    std::vector<Kept> kept_;
};

} // namespace millwright::app
