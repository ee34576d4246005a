// Another program of the desktop that drops files on a window, by the protocol that file managers speak (XDND
// 5, freedesktop.org).
#pragma once

#include <memory>
#include <string>

namespace millwright::test {

/// Needs a display.
class FileManager {
public:
    FileManager();
    FileManager(const FileManager&) = delete;
    FileManager& operator=(const FileManager&) = delete;
    ~FileManager();

    /// Lets go over the window with this title. `uris`: one per line, each line ended by CR LF.
    void drop(const std::string& title, const std::string& uris);
    /// Hands over what it dropped when it is asked for it; true once the other has said that it has it.
    [[nodiscard]] bool answers_until_taken();

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

} // namespace millwright::test
