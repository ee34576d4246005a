#include "ui/panels/file_panel.h"

#include "core/base/error.h"
#include "core/project/imported_surface.h"
#include "core/project/plot_input.h"
#include "ui/actions/processor_texts.h"
#include "ui/actions/workshop.h"
#include "ui/panels/asked_file.h"
#include "ui/widgets/icons.h"
#include "ui/widgets/table.h"
#include "ui/widgets/typed_text.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>

namespace millwright::panels {

namespace fs = std::filesystem;

namespace {

namespace icons = widgets::icons;
using actions::FileQuestion;
using widgets::Permission;
using widgets::Rank;

constexpr std::size_t longest_folder = 62; // letters that fit beside the buttons

struct Listed {
    std::vector<fs::path> folders, files;
    std::string fault;
};

/// Folders and the files of `question` by name; hidden ones left out.
Listed listed(const fs::path& folder, FileQuestion question) {
    Listed result;
    std::error_code failure;
    for (const auto& entry : fs::directory_iterator(folder, failure)) {
        std::error_code unreadable;
        if (entry.path().filename().string().starts_with('.')) {
            continue;
        }
        if (entry.is_directory(unreadable)) {
            result.folders.push_back(entry.path());
        } else if (is_listed(about(question), entry.path())) {
            result.files.push_back(entry.path());
        }
    }
    result.fault = failure ? "This folder cannot be read: " + failure.message() : std::string();
    std::sort(result.folders.begin(), result.folders.end());
    std::sort(result.files.begin(), result.files.end());
    return result;
}

/// Of a file; empty for a project.
std::string file_kind(const fs::path& file) {
    return is_gcode(file)                     ? "G-code"
           : project::is_importable(file)     ? "surface"
           : project::is_picture_file(file)   ? "picture"
           : project::is_path_file(file)      ? "path file"
           : project::is_point_file(file)     ? "point file"
           : project::is_plot_file(file)      ? "plot"
           : actions::is_processor_file(file) ? "for the processor"
                                              : "";
}

/// The project's; for a surface that of the last one, which mostly comes from elsewhere.
fs::path starting_folder(const Workbench& now, FileQuestion question) {
    if (question == FileQuestion::import_surface) {
        const auto last = std::ranges::find_if(now.recent, project::is_importable);
        std::error_code gone;
        if (last != now.recent.end() && fs::is_directory(last->parent_path(), gone)) {
            return last->parent_path();
        }
    }
    return now.document.file.empty() ? fs::current_path() : fs::absolute(now.document.file).parent_path();
}

fs::path home() {
    const char* named = std::getenv("HOME");
    return named != nullptr && *named != '\0' ? fs::path(named) : fs::path("/");
}

/// The end of a long path, which tells more than its beginning.
std::string shortened_folder(const fs::path& folder) {
    const std::string whole = folder.string();
    return whole.size() <= longest_folder ? whole
                                          : "\u2026" + whole.substr(whole.size() - longest_folder + 1);
}

bool same_file(const fs::path& a, const fs::path& b) {
    std::error_code missing;
    return fs::equivalent(a, b, missing);
}

/// The project's where the question has none of its own.
std::string first_name(const Workbench& now, const AskedFile& asked) {
    if (!asked.first.empty()) {
        return std::string(asked.first);
    }
    constexpr std::string_view project = ".millwright"; // by which a desktop knows the file
    if (now.document.file.empty()) {
        const std::string_view kind = asked.question == FileQuestion::save_as ? project : "";
        return now.project.name + std::string(kind) + std::string(asked.ending);
    }
    if (asked.question != FileQuestion::write_program) {
        return now.document.file.filename().string();
    }
    fs::path name = now.document.file.stem();
    name = name.extension() == project ? name.stem() : name;
    return name.string() + std::string(asked.ending);
}

} // namespace

void FilePanel::begin(const Workbench& now) {
    asked_ = now.session.question;
    source_ = Source::folder;
    named_.clear();
    answered_ = false;
    enter(starting_folder(now, asked_));
    name_ = first_name(now, about(asked_));
}

void FilePanel::enter(const fs::path& folder) {
    Listed found = listed(folder, asked_);
    folder_ = folder;
    folders_ = found.folders.size();
    entries_ = std::move(found.folders);
    entries_.insert(entries_.end(), found.files.begin(), found.files.end());
    fault_ = std::move(found.fault);
    chosen_.clear();
}

void FilePanel::show_recent(const Workbench& now) {
    folders_ = 0;
    entries_ = now.recent;
    fault_.clear();
    chosen_.clear();
}

void FilePanel::draw(Ui& ui, const Workbench& now, ActionQueue& ask) {
    if (asked_ != now.session.question) {
        begin(now);
    }
    const bool opening = about(asked_).opens;
    const auto dialog = ui.dialog("files", std::string(about(asked_).title), ui.px(620.0F));
    if (!dialog) {
        return;
    }
    draw_source(ui, now, ask);
    draw_entries(ui, now, ask);
    if (opening) {
        draw_open(ui, now, ask);
    } else {
        draw_save(ui, now, ask);
    }
}

/// What was typed: a folder to look into, or a file.
void FilePanel::go_to(const fs::path& typed, ActionQueue& ask) {
    const fs::path place = (typed.is_absolute() ? typed : folder_ / typed).lexically_normal();
    std::error_code missing;
    if (fs::is_directory(place, missing)) {
        enter(place);
    } else if (about(asked_).opens && fs::is_regular_file(place, missing)) {
        chosen_.clear();
        open(ask, place);
    } else {
        entries_.clear();
        folders_ = 0;
        chosen_.clear();
        fault_ = "There is no " + place.string() + ".";
    }
}

void FilePanel::draw_source(Ui& ui, const Workbench& now, ActionQueue& ask) {
    const std::array<widgets::Option, 2> sources{
        {{"folder", "Folder", icons::folder}, {"recent", "Recent", icons::timer}}};
    if (asked_ == FileQuestion::open) {
        if (const auto source = ui.tabs("source", static_cast<int>(source_), sources)) {
            source_ = static_cast<Source>(*source);
            source_ == Source::folder ? enter(folder_) : show_recent(now);
        }
    }
    if (source_ == Source::recent) {
        return;
    }
    const auto above =
        folder_.has_relative_path() ? Permission{} : Permission::refused("There is no folder above.");
    if (ui.icon_button("up", icons::back, "The folder above", above)) {
        enter(folder_.parent_path());
    }
    ui.beside();
    if (ui.icon_button("home", icons::home, "Your home folder")) {
        enter(home());
    }
    ui.beside();
    if (const auto typed = ui.text_field("path", "", folder_.string(), "A folder to look into, or a file")) {
        go_to(*typed, ask);
    }
}

void FilePanel::draw_entries(Ui& ui, const Workbench& /*now*/, ActionQueue& ask) {
    constexpr std::array<widgets::Column, 2> columns{{{"Name", "", 2.0F, false}, {"", "", 3.0F, false}}};
    widgets::TableView view;
    view.columns = columns;
    view.rows = std::ssize(entries_);
    view.cell = [this](std::ptrdiff_t row, int column) {
        const fs::path& entry = entries_[static_cast<std::size_t>(row)];
        if (column == 0) {
            return entry.filename().string();
        }
        const bool is_folder = static_cast<std::size_t>(row) < folders_;
        return source_ == Source::recent ? shortened_folder(entry.parent_path())
               : is_folder               ? std::string("folder")
                                         : file_kind(entry);
    };
    view.row_id = [this](std::ptrdiff_t row) {
        const fs::path& entry = entries_[static_cast<std::size_t>(row)];
        return source_ == Source::recent ? std::to_string(row) : entry.filename().string();
    };
    const auto chosen = std::find(entries_.begin(), entries_.end(), chosen_);
    view.chosen = chosen == entries_.end() ? -1 : chosen - entries_.begin();
    view.height = ui.px(212.0F);
    const std::string_view none =
        source_ == Source::recent ? "Nothing was opened or saved before." : about(asked_).none;
    view.when_empty = fault_.empty() ? none : std::string_view(fault_);
    const auto row = widgets::table(ui, "entries", view);
    if (!row) {
        return;
    }
    const fs::path entry = entries_[static_cast<std::size_t>(*row)];
    if (static_cast<std::size_t>(*row) < folders_) {
        enter(entry);
    } else if (about(asked_).opens && entry == chosen_) { // the second click of two
        open(ask, entry);
    } else {
        chosen_ = entry;
        name_ = entry.filename().string();
    }
}

void FilePanel::draw_open(Ui& ui, const Workbench& now, ActionQueue& ask) {
    ui.gap();
    if (asked_ != FileQuestion::open) {
        ui.note(chosen_.empty() ? " " : chosen_.filename().string());
    } else if (project::is_importable(chosen_)) {
        ProjectPreview::draw_words(
            ui, "A surface of another program: it is shown first, in the Design workspace.");
    } else if (is_gcode(chosen_)) {
        ProjectPreview::draw_words(
            ui,
            now.session.workspace == actions::Workspace::plot
                ? "A G-code program: it is cut as it stands, here in the Plot & Picture workspace."
                : "A G-code program: it opens beside the project, in the Program workspace.");
    } else if (actions::is_processor_file(chosen_)) {
        ProjectPreview::draw_words(ui, "Of the CORDIC processor: it opens in the Processor workspace.");
    } else if (project::is_plot_file(chosen_)) {
        ProjectPreview::draw_words(
            ui, "A " + file_kind(chosen_) + ": it is cut in the Plot & Picture workspace.");
    } else {
        preview_.draw(ui, chosen_);
    }
    ui.gap();
    const auto row = ui.row(2);
    draw_cancel(ui, now, ask);
    const auto allowed = chosen_.empty() ? Permission::refused("Choose a file first.") : Permission{};
    const bool entered = ui.enter_pressed() && allowed.allowed;
    if (ui.button("open", "Open", allowed, {icons::folder, Rank::primary, -1.0F, "Enter"}) || entered) {
        open(ask, chosen_);
    }
}

void FilePanel::open(ActionQueue& ask, const fs::path& file) const {
    if (const auto answer = about(asked_).answer) {
        ask.files([answer, file](actions::Workshop& workshop) { answer(workshop, file); });
    } else {
        ask.open_file(file);
    }
}

fs::path FilePanel::file_to_save(std::string_view name) const {
    fs::path file = folder_ / name;
    return file.has_extension() ? file : file.replace_extension(about(asked_).ending);
}

/// Whether saving to `file` destroys something: not where the project that is open lies already.
bool FilePanel::replaces(const fs::path& file, const Workbench& now) const {
    std::error_code unreadable;
    const bool is_own = asked_ == FileQuestion::save_as && same_file(file, now.document.file);
    return fs::exists(file, unreadable) && !is_own;
}

void FilePanel::draw_save(Ui& ui, const Workbench& now, ActionQueue& ask) {
    if (std::exchange(answered_, false)) {
        ui.focus_field(ui.path("name"));
    }
    const bool elsewhere = ui.was_typing() && !widgets::typed_text(ui, "name");
    name_ = ui.text_field("name", "File name", name_, ending_text(about(asked_))).value_or(name_);
    const std::string name = widgets::typed_text(ui, "name").value_or(name_);
    const fs::path file = file_to_save(name);
    std::error_code unreadable;
    const Permission allowed = name.empty() ? Permission::refused("Type a file name first.")
                               : fs::is_directory(file, unreadable)
                                   ? Permission::refused(file.filename().string() + " is a folder.")
                                   : Permission{};
    const fs::path replaced = allowed.allowed && replaces(file, now) ? file : fs::path();
    ui.note(replaced.empty() ? ending_text(about(asked_))
                             : file.filename().string() + " is there already and would be replaced.");
    const auto row = ui.row(2);
    draw_cancel(ui, now, ask);
    const bool clicked = draw_save_button(ui, allowed, replaced);
    // Enter replaces nothing, and is none of this dialog's while a folder is typed.
    const bool entered = ui.enter_pressed() && !elsewhere && allowed.allowed && replaced.empty();
    if (clicked || entered) {
        answered_ = true;
        ui.change_in(0.0);
        if (const auto answer = about(asked_).answer) {
            ask.files([answer, file](actions::Workshop& workshop) { answer(workshop, file); });
        } else {
            ask.save_file(file);
        }
    }
}

/// Whether `replaced` (empty: nothing) and what else there is may be written. A click counts for the file
/// that the button named before the mouse went down: one that came to be meanwhile, of another program or
/// since the name was changed, makes it another button.
bool FilePanel::draw_save_button(Ui& ui, const Permission& allowed, const fs::path& replaced) {
    const bool is_news = std::exchange(named_, replaced) != replaced;
    if (is_news) {
        ui.change_in(0.0);
    }
    const std::string_view id = is_news ? "changing" : replaced.empty() ? "save" : "replace";
    return ui.button(id,
                     replaced.empty() ? "Save" : "Replace",
                     allowed,
                     {icons::save,
                      replaced.empty() ? Rank::primary : Rank::danger,
                      -1.0F,
                      replaced.empty() ? "Enter" : ""});
}

void FilePanel::draw_cancel(Ui& ui, const Workbench& now, ActionQueue& ask) const {
    const bool escaped = ui.escape_pressed() && !ui.is_typing();
    if (ui.button("cancel", "Cancel", {}, {{}, Rank::normal, -1.0F, "Esc"}) || escaped) {
        ask.show([](actions::Session& session) { session.question = FileQuestion::none; });
        if (!now.leaving_to.empty()) { // the file was asked for to save what is unsaved
            ask.run("unsaved.cancel");
        }
    }
}

} // namespace millwright::panels
