// Copies of unsaved work beside the user's data, so that a crash loses little. Every running program holds
// the lock of its own copy; a copy whose lock is free was left behind by a program that did not end well.
#pragma once

#include "core/base/error.h"
#include "core/project/project.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

namespace millwright::project {

struct UnsavedWork {
    Project project;
    std::filesystem::path file; ///< that the project was opened from or saved to; empty if none
    std::int64_t time_s = 0;    ///< when the copy was made, s since 1970-01-01 UTC

    friend bool operator==(const UnsavedWork&, const UnsavedWork&) = default;
};

/// Deterministic bytes. Throws Error with the first of faults_of(work.project) if there is one.
[[nodiscard]] std::string recovery_text(const UnsavedWork& work);
/// Throws Error with file and line for anything wrong in it.
[[nodiscard]] UnsavedWork read_recovery(const std::filesystem::path& copy);

class FileLock;

/// The copy of one running program. The copy stays behind unless it is removed.
class RecoveryCopy {
public:
    /// Makes `folder` where missing and locks a name in it that is free. Throws Error if it cannot.
    explicit RecoveryCopy(const std::filesystem::path& folder);
    RecoveryCopy(RecoveryCopy&&) noexcept;
    RecoveryCopy& operator=(RecoveryCopy&&) noexcept;
    ~RecoveryCopy();

    [[nodiscard]] const std::filesystem::path& file() const { return file_; }
    /// Replaces the copy. Throws Error; the copy before then stays.
    void write(const UnsavedWork& work) const;
    void remove() const;

private:
    std::unique_ptr<FileLock> lock_;
    std::filesystem::path file_;
};

/// A copy that was left behind. As long as this lives no other program is offered it.
class LeftBehind {
public:
    LeftBehind(std::unique_ptr<FileLock> lock, std::filesystem::path copy);
    LeftBehind(LeftBehind&&) noexcept;
    LeftBehind& operator=(LeftBehind&&) noexcept;
    ~LeftBehind();

    [[nodiscard]] const std::filesystem::path& copy() const { return copy_; }
    /// Empty if the copy cannot be read; fault() then says why.
    [[nodiscard]] const std::optional<UnsavedWork>& work() const { return work_; }
    [[nodiscard]] const std::optional<Diagnostic>& fault() const { return fault_; }
    /// Removes the copy.
    void discard() const;

private:
    std::unique_ptr<FileLock> lock_;
    std::filesystem::path copy_;
    std::optional<UnsavedWork> work_;
    std::optional<Diagnostic> fault_;
};

/// What was left behind in `folder`, newest first. Copies of running programs are passed over; so is a folder
/// that is not there.
[[nodiscard]] std::vector<LeftBehind> left_behind(const std::filesystem::path& folder);

/// $XDG_STATE_HOME/millwright/recovery, by default in ~/.local/state; empty if there is no home.
[[nodiscard]] std::filesystem::path recovery_place();

} // namespace millwright::project
