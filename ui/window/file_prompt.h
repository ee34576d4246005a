// What files the window asks for: the title, which ones are listed, what a name ends in, what becomes of the
// file.
#pragma once

#include "ui/actions/app_controller.h"
#include "ui/workspaces/view_state.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace millwright::panels {

/// What is asked for, and what becomes of the file.
struct FilePromptRow {
    actions::FilePrompt prompt;
    std::string_view title;
    bool opens;
    std::string_view ending; ///< of what is listed and saved; empty: every file
    std::string_view first;  ///< name to save to; empty: the project's
    void (*answer)(actions::AppController&, const std::filesystem::path&);
    std::string_view none;                                 ///< where nothing is listed
    bool (*lists)(const std::filesystem::path&) = nullptr; ///< in place of the ending; null: that
};

/// Throws Defect for FilePrompt::none.
[[nodiscard]] const FilePromptRow& about(actions::FilePrompt prompt);

/// By ViewState::folders: questions of one use share the folder where they begin.
[[nodiscard]] std::string_view use_of(actions::FilePrompt prompt);

[[nodiscard]] bool is_gcode(const std::filesystem::path& file);

/// Whether a file has a place in the list.
[[nodiscard]] bool is_listed(const FilePromptRow& asked, const std::filesystem::path& file);

/// What the name ends in that is saved to, as a sentence.
[[nodiscard]] std::string ending_text(const FilePromptRow& asked);

} // namespace millwright::panels
