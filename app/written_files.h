// What this user's commands have written into folders, so that nothing else there is replaced.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace millwright::app {

/// Kept beside the list of recent files, for a few thousand files that are still there; nowhere without a
/// home.
class WrittenFiles {
public:
    /// What cannot be read is as if nothing had been written.
    WrittenFiles();

    /// Whether `file` still has the bytes that a command wrote there last.
    [[nodiscard]] bool holds(const std::filesystem::path& file) const;
    /// False for what cannot be read.
    [[nodiscard]] static bool same_bytes(const std::filesystem::path& a, const std::filesystem::path& b);
    /// From now on, also for commands to come. What cannot be kept is forgotten.
    void add(const std::vector<std::filesystem::path>& files);

private:
    std::filesystem::path place_;               ///< empty: nowhere
    std::map<std::string, std::string> hashes_; ///< of the bytes, by whole path
};

} // namespace millwright::app
