// What a person does who follows a document: its commands are run where its files are.
#pragma once

#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace millwright::test {

/// Commands in lines of their own, four blanks in; without those that stand for any (PROJECT, [--json]).
[[nodiscard]] std::vector<std::string> indented_commands_of(const std::string& document);

/// The files that a document shows: name and text of each fenced block behind a line that ends with
/// "`NAME.ending`:".
[[nodiscard]] std::map<std::string, std::string> files_of(const std::string& document);

/// What a document says that a command prints: the block without a language behind a line that ends with
/// "prints", and the last command of the shell before it.
struct Listing {
    std::string command;
    std::string text;
};
[[nodiscard]] std::vector<Listing> listings_of(const std::string& document);

/// Markdown pages in `folder` and below it, sorted.
[[nodiscard]] std::vector<std::filesystem::path> documents_in(const std::filesystem::path& folder);

/// A checkout as the commands see it, with the files that they name and emulated controllers at their ports.
class Guide : public testing::Test {
protected:
    Guide();
    ~Guide() override;

    /// Writes the files that the document shows and runs its commands: those of its blocks, then those four
    /// blanks in. Each prints what a listing behind it shows. The number of commands.
    int follow_document(const std::string& document);

    /// Runs the commands, an emulator in the background until the test ends. The number of commands.
    int follow(const std::vector<std::string>& commands);

    ScratchFolder checkout;

private:
    /// As it can be run here: with ports of ours, and no slower than it computes.
    [[nodiscard]] std::string here(std::string command) const;
    /// In the background, until the test ends; its port is there then.
    void start(const std::string& command);
    void stop_emulators();
    /// To its end, with 0; what it names by --out is there then. With MILLWRIGHT_DOCUMENT_LOG set to a file,
    /// its exit code and first line of output are added there, and whether each listing is the same.
    void run_shown(const std::string& command);

    std::vector<std::string> emulators_;         ///< process numbers
    std::map<std::string, std::string> printed_; ///< by commands that ended
};

} // namespace millwright::test
