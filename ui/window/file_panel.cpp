#include "ui/window/file_panel.h"

#include "core/base/error.h"
#include "core/project/imported_surface.h"
#include "core/project/plot_input.h"
#include "ui/actions/app_controller.h"
#include "ui/panels/numbers_text.h"
#include "ui/widgets/icons.h"
#include "ui/widgets/table.h"
#include "ui/widgets/typed_text.h"
#include "ui/window/file_prompt.h"
#include "ui/workspaces/processor_texts.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

namespace millwright::panels {

namespace fs = std::filesystem;

namespace {

namespace icons = widgets::icons;
using actions::FilePrompt;
using widgets::Permission;
using widgets::Rank;

constexpr std::size_t longest_folder = 62; // letters that fit beside the buttons

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

/// The project's where the prompt has none of its own.
std::string first_name(const FrameState& now, const FilePromptRow& asked) {
    if (!asked.first.empty()) {
        return std::string(asked.first);
    }
    constexpr std::string_view project = ".millwright"; // by which a desktop knows the file
    if (now.document.file.empty()) {
        const std::string_view kind = asked.prompt == FilePrompt::save_as ? project : "";
        return now.project.name + std::string(kind) + std::string(asked.ending);
    }
    if (asked.prompt != FilePrompt::write_program) {
        return now.document.file.filename().string();
    }
    fs::path name = now.document.file.stem();
    name = name.extension() == project ? name.stem() : name;
    return name.string() + std::string(asked.ending);
}

} // namespace

void FilePanel::begin(const FrameState& now) {
    asked_ = now.view_state.file_prompt;
    source_ = Source::folder;
    filter_ = 0;
    named_.clear();
    answered_ = false;
    enter(starting_folder(now, about(asked_)));
    name_ = first_name(now, about(asked_));
}

void FilePanel::enter(const fs::path& folder) {
    FolderListing found = listed(folder, about(asked_), filters_of(asked_)[filter_]);
    folder_ = folder;
    entries_ = std::move(found.entries);
    fault_ = std::move(found.fault);
    chosen_.clear();
    to_top_ = true;
}

void FilePanel::show_recent(const FrameState& now) {
    entries_.clear();
    std::ranges::transform(now.recent, std::back_inserter(entries_), entry_of);
    fault_.clear();
    chosen_.clear();
    to_top_ = true;
}

void FilePanel::draw(Ui& ui, const FrameState& now, ActionQueue& ask) {
    if (asked_ != now.view_state.file_prompt) {
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
        chosen_.clear();
        fault_ = "Not found: " + place.string() + ".";
    }
}

void FilePanel::draw_source(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const std::array<widgets::Option, 2> sources{
        {{"folder", "Folder", icons::folder}, {"recent", "Recent", icons::timer}}};
    if (asked_ == FilePrompt::open) {
        if (const auto source = ui.tabs("source", static_cast<int>(source_), sources)) {
            source_ = static_cast<Source>(*source);
            source_ == Source::folder ? enter(folder_) : show_recent(now);
        }
    }
    if (source_ == Source::recent) {
        return;
    }
    const auto above =
        folder_.has_relative_path() ? Permission{} : Permission::refused("There is no parent folder.");
    if (ui.icon_button("up", icons::back, "Parent folder", above)) {
        enter(folder_.parent_path());
    }
    ui.beside();
    draw_places(ui, now);
    ui.beside();
    if (const auto typed = ui.text_field("path", "", folder_.string(), "Path of a folder or file")) {
        go_to(*typed, ask);
    }
}

/// A folder is chosen and entered at once: of two clicks on a row the second one would enter what has taken
/// its place.
void FilePanel::draw_places(Ui& ui, const FrameState& now) {
    const std::vector<FilePlace> places = places_of(now);
    std::vector<std::string> ids;
    for (std::size_t n = 0; n < places.size(); ++n) {
        ids.push_back("place" + std::to_string(n));
    }
    std::vector<widgets::Option> options{{"none", "Go to ...", icons::home}};
    for (std::size_t n = 0; n < places.size(); ++n) {
        options.push_back({ids[n], places[n].label, icons::folder});
    }
    const auto width = ui.width(ui.px(130.0F));
    if (const auto chosen =
            ui.choice("places", "", 0, options, "Go to home, project, samples, recent folders or drives");
        chosen && *chosen > 0) {
        enter(places[static_cast<std::size_t>(*chosen) - 1].folder);
    }
}

void FilePanel::draw_filter(Ui& ui) {
    std::vector<widgets::Option> options;
    for (const FileFilter& filter : filters_of(asked_)) {
        options.push_back({filter.id, filter.label});
    }
    const auto labels = ui.label_share(0.12F);
    if (const auto chosen = ui.choice("filter", "Show", static_cast<int>(filter_), options)) {
        filter_ = static_cast<std::size_t>(*chosen);
        enter(folder_);
    }
}

std::string FilePanel::cell(const FolderEntry& entry, int column) const {
    enum Column { name, kind, size, changed };
    switch (column) {
    case name:
        return entry.path.filename().string();
    case kind:
        return source_ == Source::recent ? shortened_folder(entry.path.parent_path()) : entry.kind;
    case size:
        return entry.is_folder || entry.changed_s < 0 ? std::string() : size_text(entry.bytes);
    default:
        return date_time_text(entry.changed_s);
    }
}

void FilePanel::draw_entries(Ui& ui, const FrameState& /*now*/, ActionQueue& ask) {
    constexpr std::array<widgets::Column, 4> columns{{{"Name", "", 2.6F, false},
                                                      {"Type", "", 1.3F, false},
                                                      {"Size", "", 1.0F, true},
                                                      {"Modified", "", 2.2F, true}}};
    constexpr std::array<widgets::Column, 4> of_recent{{{"Name", "", 2.0F, false},
                                                        {"Folder", "", 2.6F, false},
                                                        {"Size", "", 1.0F, true},
                                                        {"Modified", "", 2.1F, true}}};
    widgets::TableView view;
    view.columns = source_ == Source::recent ? of_recent : columns;
    view.rows = std::ssize(entries_);
    view.cell = [this](std::ptrdiff_t row, int column) {
        return cell(entries_[static_cast<std::size_t>(row)], column);
    };
    view.row_id = [this](std::ptrdiff_t row) {
        const fs::path& entry = entries_[static_cast<std::size_t>(row)].path;
        return source_ == Source::recent ? std::to_string(row) : entry.filename().string();
    };
    const auto chosen = std::ranges::find(entries_, chosen_, &FolderEntry::path);
    view.chosen = chosen == entries_.end() ? -1 : chosen - entries_.begin();
    view.wanted = std::exchange(to_top_, false) && !entries_.empty() ? 0 : -1;
    view.height = ui.px(232.0F);
    const std::string_view none = source_ == Source::recent ? "No recent files." : about(asked_).none;
    view.when_empty = fault_.empty() ? none : std::string_view(fault_);
    if (const auto row = widgets::table(ui, "entries", view)) {
        take(entries_[static_cast<std::size_t>(*row)], ask);
    }
    if (source_ == Source::folder) {
        draw_filter(ui);
    }
}

/// A click chooses, the second of two enters a folder or opens a file.
void FilePanel::take(const FolderEntry& clicked, ActionQueue& ask) {
    const FolderEntry entry = clicked; // entering replaces the entries
    if (entry.path != chosen_) {
        chosen_ = entry.path;
        name_ = entry.is_folder ? name_ : entry.path.filename().string();
    } else if (entry.is_folder) {
        enter(entry.path);
    } else if (about(asked_).opens) {
        open(ask, entry.path);
    }
}

void FilePanel::draw_open(Ui& ui, const FrameState& now, ActionQueue& ask) {
    ui.gap();
    if (asked_ != FilePrompt::open) {
        ui.note(chosen_.empty() ? " " : chosen_.filename().string());
    } else if (entry_of(chosen_).is_folder) {
        ProjectPreview::draw_words(ui, "A folder: click it again, or press Enter, to open it.");
    } else if (project::opens_as_surface(chosen_)) {
        ProjectPreview::draw_words(
            ui, "A surface from another program: it opens as a preview in the Design workspace.");
    } else if (is_gcode(chosen_)) {
        ProjectPreview::draw_words(
            ui,
            now.view_state.workspace == actions::Workspace::plot
                ? "A G-code program: it opens here in the Plot & Picture workspace and is used unchanged."
                : "A G-code program: it opens in the Program workspace; the project stays open.");
    } else if (actions::is_processor_file(chosen_)) {
        ProjectPreview::draw_words(ui,
                                   "A file for the CORDIC processor: it opens in the Processor workspace.");
    } else if (project::is_plot_file(chosen_)) {
        ProjectPreview::draw_words(ui,
                                   "A " + file_kind(chosen_) + ": it opens in the Plot & Picture workspace.");
    } else {
        preview_.draw(ui, chosen_);
    }
    ui.gap();
    const auto row = ui.row(2);
    draw_cancel(ui, now, ask);
    const auto allowed = chosen_.empty() ? Permission::refused("Select a file first.") : Permission{};
    const bool entered = ui.enter_pressed() && allowed.allowed;
    if (ui.button("open", "Open", allowed, {icons::folder, Rank::primary, -1.0F, "Enter"}) || entered) {
        const FolderEntry entry = entry_of(chosen_);
        if (entry.is_folder) {
            enter(entry.path);
        } else {
            open(ask, chosen_);
        }
    }
}

/// The next prompt of this use begins there.
void FilePanel::remember_folder(ActionQueue& ask, const fs::path& file) const {
    ask.show([use = std::string(use_of(asked_)), folder = file.parent_path()](
                 actions::ViewState& view_state) { view_state.folders[use] = folder; });
}

void FilePanel::open(ActionQueue& ask, const fs::path& file) const {
    remember_folder(ask, file);
    if (const auto answer = about(asked_).answer) {
        ask.files([answer, file](actions::AppController& app) { answer(app, file); });
    } else {
        ask.open_file(file);
    }
}

fs::path FilePanel::file_to_save(std::string_view name) const {
    fs::path file = folder_ / name;
    return file.has_extension() ? file : file.replace_extension(about(asked_).ending);
}

/// Whether saving to `file` destroys something: not where the project that is open lies already.
bool FilePanel::replaces(const fs::path& file, const FrameState& now) const {
    std::error_code unreadable;
    const bool is_own = asked_ == FilePrompt::save_as && same_file(file, now.document.file);
    return fs::exists(file, unreadable) && !is_own;
}

void FilePanel::draw_save(Ui& ui, const FrameState& now, ActionQueue& ask) {
    if (std::exchange(answered_, false)) {
        ui.focus_field(ui.path("name"));
    }
    const bool elsewhere = ui.was_typing() && !widgets::typed_text(ui, "name");
    name_ = ui.text_field("name", "File name", name_, ending_text(about(asked_))).value_or(name_);
    const std::string name = widgets::typed_text(ui, "name").value_or(name_);
    const fs::path file = file_to_save(name);
    std::error_code unreadable;
    const Permission allowed = name.empty() ? Permission::refused("Enter a file name first.")
                               : fs::is_directory(file, unreadable)
                                   ? Permission::refused(file.filename().string() + " is a folder.")
                                   : Permission{};
    const fs::path replaced = allowed.allowed && replaces(file, now) ? file : fs::path();
    ui.note(replaced.empty() ? ending_text(about(asked_))
                             : file.filename().string() + " already exists and will be replaced.");
    const auto row = ui.row(2);
    draw_cancel(ui, now, ask);
    const bool clicked = draw_save_button(ui, allowed, replaced);
    // Enter replaces nothing, and is none of this dialog's while a folder is typed.
    const bool entered = ui.enter_pressed() && !elsewhere && allowed.allowed && replaced.empty();
    if (clicked || entered) {
        answered_ = true;
        ui.change_in(0.0);
        remember_folder(ask, file);
        if (const auto answer = about(asked_).answer) {
            ask.files([answer, file](actions::AppController& app) { answer(app, file); });
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

void FilePanel::draw_cancel(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    const bool escaped = ui.escape_pressed() && !ui.is_typing();
    if (ui.button("cancel", "Cancel", {}, {{}, Rank::normal, -1.0F, "Esc"}) || escaped) {
        ask.show([](actions::ViewState& view_state) { view_state.file_prompt = FilePrompt::none; });
        if (!now.leaving_to.empty()) { // the file was asked for to save what is unsaved
            ask.run("unsaved.cancel");
        }
    }
}

} // namespace millwright::panels
