// What files the window asks for: the title, which ones are listed, what a name ends in, what becomes of the
// file.
#pragma once

#include "ui/actions/session.h"
#include "ui/actions/workshop.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace millwright::panels {

/// What is asked for, and what becomes of the file.
struct AskedFile {
    actions::FileQuestion question;
    std::string_view title;
    bool opens;
    std::string_view ending; ///< of what is listed and saved; empty: every file
    std::string_view first;  ///< name to save to; empty: the project's
    void (*answer)(actions::Workshop&, const std::filesystem::path&);
    std::string_view none;                                 ///< where nothing is listed
    bool (*lists)(const std::filesystem::path&) = nullptr; ///< in place of the ending; null: that
};

/// Throws Defect for FileQuestion::none.
[[nodiscard]] const AskedFile& about(actions::FileQuestion question);

/// By Session::folders: questions of one use share the folder where they begin.
[[nodiscard]] std::string_view use_of(actions::FileQuestion question);

[[nodiscard]] bool is_gcode(const std::filesystem::path& file);

/// Whether a file has a place in the list.
[[nodiscard]] bool is_listed(const AskedFile& asked, const std::filesystem::path& file);

/// What the name ends in that is saved to, as a sentence.
[[nodiscard]] std::string ending_text(const AskedFile& asked);

} // namespace millwright::panels
