// What this user's commands have written into folders, so that nothing else there is replaced.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::app {

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

} // namespace millwright::app
