// Files and folders that options name to be written: a command never writes over what it reads, and finds out
// before its work that it cannot write.
#pragma once

#include <CLI/App.hpp>

#include <filesystem>
#include <vector>

namespace millwright::app {

/// Of the commands that were meant. Throws Error where a file that is to be written (as by --out) is
/// also an argument that is read, under whatever name, or is to be written twice.
void expect_outputs_apart(const CLI::App& app);

/// Of the commands that were meant. Throws Error where a file or folder that is to be written cannot be: it
/// is a folder in place of a file or the other way round, its folder is missing or may not be written.
void expect_outputs_writable(const CLI::App& app);

/// Files that options of these commands name to be written, such as --out.
[[nodiscard]] std::vector<std::filesystem::path> named_outputs(const CLI::App& app);

} // namespace millwright::app
