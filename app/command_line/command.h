// What the commands of the command line have in common: main finds out which one is meant, then runs it.
#pragma once

#include "core/base/error.h"
#include "core/base/progress.h"
#include "core/plan/plan.h"
#include "core/project/project.h"

#include <filesystem>
#include <functional>
#include <vector>

namespace millwright::app {

// What is wrong with an input, or done otherwise than it says, on the terminal: the first of it, and how much
// there is.

void print_first(const std::vector<Diagnostic>& found);
void print_warnings(const std::vector<Diagnostic>& warnings);

/// Runs to the exit code. Throws Error or Cancelled.
using Command = std::function<int()>;

/// A project read from its file, with where its machine is looked for.
struct OpenedProject {
    std::filesystem::path file;
    project::Project project;
    plan::Folders folders;
};

/// Throws Error for anything wrong in the file.
[[nodiscard]] OpenedProject open_project(const std::filesystem::path& file);

/// make_plan under a progress bar that Ctrl+C cancels. An Error that names no file gets the project's.
[[nodiscard]] plan::Plan
planned(const OpenedProject& opened, const plan::Scope& scope, const std::stop_token& stop);

} // namespace millwright::app
