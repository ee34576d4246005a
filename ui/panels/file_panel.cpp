#include "ui/panels/file_panel.h"

#include "ui/widgets/icons.h"
#include "ui/widgets/table.h"

#include <algorithm>
#include <array>

namespace millwright::panels {

namespace fs = std::filesystem;

namespace {

bool is_project(const fs::directory_entry& entry) {
    return entry.path().extension() == ".json";
}

/// Folders first, then project files, both by name; hidden ones left out.
std::vector<fs::path> listed(const fs::path& folder, std::string& fault) {
    std::vector<fs::path> folders, files;
    std::error_code failure;
    for (const auto& entry : fs::directory_iterator(folder, failure)) {
        std::error_code unreadable;
        if (entry.path().filename().string().starts_with('.')) {
            continue;
        }
        if (entry.is_directory(unreadable)) {
            folders.push_back(entry.path());
        } else if (is_project(entry)) {
            files.push_back(entry.path());
        }
    }
    fault = failure ? failure.message() : std::string();
    std::sort(folders.begin(), folders.end());
    std::sort(files.begin(), files.end());
    folders.insert(folders.end(), files.begin(), files.end());
    return folders;
}

fs::path starting_folder(const Workbench& now) {
    return now.document.file.empty() ? fs::current_path() : fs::absolute(now.document.file).parent_path();
}

} // namespace

void FilePanel::enter(const fs::path& folder) {
    folder_ = folder;
    entries_ = listed(folder, fault_);
}

void FilePanel::choose(const fs::path& file, const Workbench& now, ActionQueue& ask) const {
    if (now.session.question == actions::FileQuestion::open) {
        ask.open_file(file);
    } else {
        ask.save_file(file);
    }
}

void FilePanel::draw(Ui& ui, const Workbench& now, ActionQueue& ask) {
    if (folder_.empty()) {
        enter(starting_folder(now));
    }
    const bool opening = now.session.question == actions::FileQuestion::open;
    ui.heading(opening ? "Open a project" : "Save the project as");
    draw_folder(ui, now, ask);
    if (opening) {
        draw_recent(ui, now, ask);
    } else {
        if (const auto typed = ui.text_field("name", "File name", name_, "Ends in .json")) {
            name_ = *typed;
        }
        const auto allowed =
            name_.empty() ? widgets::Permission::refused("Type a file name first.") : widgets::Permission{};
        if (ui.button("save", "Save", allowed, {widgets::icons::save, widgets::Rank::primary, 0.0F, {}})) {
            fs::path file = folder_ / name_;
            choose(file.has_extension() ? file : file.replace_extension(".json"), now, ask);
        }
    }
    if (ui.button("cancel", "Cancel")) {
        ask.show([](actions::Session& session) { session.question = actions::FileQuestion::none; });
    }
}

void FilePanel::draw_folder(Ui& ui, const Workbench& now, ActionQueue& ask) {
    ui.value("folder", "Folder", folder_.string());
    if (ui.button("up", "Up", {}, {widgets::icons::back, widgets::Rank::quiet, 0.0F, "The folder above"})) {
        enter(folder_.parent_path());
    }
    if (!fault_.empty()) {
        ui.text(fault_);
    }
    constexpr std::array<widgets::Column, 2> columns{{{"Name", "", 3.0F, false}, {"", "", 1.0F, false}}};
    widgets::TableView view;
    view.columns = columns;
    view.rows = std::ssize(entries_);
    view.cell = [this](std::ptrdiff_t row, int column) {
        const fs::path& entry = entries_[static_cast<std::size_t>(row)];
        return column == 0 ? entry.filename().string() : std::string(entry.has_extension() ? "" : "folder");
    };
    view.row_id = [this](std::ptrdiff_t row) {
        return entries_[static_cast<std::size_t>(row)].filename().string();
    };
    view.height = ui.px(220.0F);
    view.when_empty = "No project files here.";
    if (const auto row = widgets::table(ui, "entries", view)) {
        const fs::path chosen = entries_[static_cast<std::size_t>(*row)];
        std::error_code unreadable;
        if (fs::is_directory(chosen, unreadable)) {
            enter(chosen);
        } else if (now.session.question == actions::FileQuestion::open) {
            choose(chosen, now, ask);
        } else {
            name_ = chosen.filename().string();
        }
    }
}

void FilePanel::draw_recent(Ui& ui, const Workbench& now, ActionQueue& ask) const {
    if (now.document.recent.empty()) {
        return;
    }
    const auto section = ui.section("recent", "Recent files");
    if (!section) {
        return;
    }
    int n = 0;
    for (const fs::path& file : now.document.recent) {
        const std::string id = "file" + std::to_string(++n);
        if (ui.button(id, file.filename().string(), {}, {{}, widgets::Rank::quiet, -1.0F, file.string()})) {
            choose(file, now, ask);
        }
    }
}

} // namespace millwright::panels
