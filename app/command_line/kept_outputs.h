// Files that a command would replace and that Millwright has not written: they stay under another name.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace millwright::app {

// What this user's commands have written into folders, so that nothing else there is replaced.

/// Its whole path, by which it is known whatever way leads to its folder; empty where the folder is missing.
[[nodiscard]] std::string lasting_path(const std::filesystem::path& file);

/// Kept beside the list of recent files, for a few thousand files that are still there; nowhere without a
/// home.
class WrittenFiles {
public:
    /// What cannot be read is as if nothing had been written.
    WrittenFiles();

    /// Whether `file` still has the bytes that a command wrote there last.
    [[nodiscard]] bool holds(const std::filesystem::path& file) const;
    /// Whether a command has written `file` once, whatever is there now.
    [[nodiscard]] bool knows(const std::filesystem::path& file) const;
    /// False for what cannot be read.
    [[nodiscard]] static bool same_bytes(const std::filesystem::path& a, const std::filesystem::path& b);
    /// Whether a command wrote `file` last, with other bytes than these.
    [[nodiscard]] bool had_other_bytes(const std::filesystem::path& file, std::string_view bytes) const;
    /// Whether a command wrote `file` last, with these bytes.
    [[nodiscard]] bool had_bytes(const std::filesystem::path& file, std::string_view bytes) const;
    /// Files of sets of this kind directly in `folder`, whether or not they are still there. None for no
    /// kind.
    [[nodiscard]] std::vector<std::filesystem::path> of_kind(std::string_view kind,
                                                             const std::filesystem::path& folder) const;
    /// The other files that belong to what a command wrote as `file`, whether or not they are still there.
    [[nodiscard]] std::vector<std::filesystem::path> written_with(const std::filesystem::path& file) const;
    /// From now on, also for commands to come. What cannot be kept is forgotten.
    void add(const std::vector<std::filesystem::path>& files);
    /// The same for files that belong together. Files that belonged to one of them that has kept its bytes
    /// belong to all of them. `kind`: of the set, may be empty.
    void add_set(const std::vector<std::filesystem::path>& files, const std::string& kind);

private:
    struct Entry {
        std::string hash;   ///< of the bytes
        std::string set;    ///< the same for all files that belong together; empty: it belongs to none
        std::string kind{}; ///< of its set
    };
    using Entries = std::map<std::string, Entry>; ///< by whole path

    [[nodiscard]] static Entries read_entries(const std::filesystem::path& place);
    void add(const std::vector<std::filesystem::path>& files, bool together, const std::string& kind);
    void put(const std::vector<std::filesystem::path>& files, bool together, const std::string& kind);
    void write() const;

    std::filesystem::path place_; ///< empty: nowhere
    Entries entries_;
};

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
