// Choosing a file to open or to save to: a folder's project files or the recent ones, with a preview, in a
// dialog.
#pragma once

#include "ui/panels/panel.h"
#include "ui/window/folder_view.h"
#include "ui/window/project_preview.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::panels {

class FilePanel {
public:
    /// While view_state.file_prompt asks for a file.
    void draw(Ui& ui, const FrameState& now, ActionQueue& ask);
    /// The prompt is over: the next one begins anew.
    void close() { asked_ = actions::FilePrompt::none; }

private:
    enum class Source { folder, recent };

    void begin(const FrameState& now);
    void enter(const std::filesystem::path& folder);
    void show_recent(const FrameState& now);
    void go_to(const std::filesystem::path& typed, ActionQueue& ask);
    void draw_source(Ui& ui, const FrameState& now, ActionQueue& ask);
    void draw_places(Ui& ui, const FrameState& now);
    void draw_filter(Ui& ui);
    void draw_entries(Ui& ui, const FrameState& now, ActionQueue& ask);
    [[nodiscard]] std::string cell(const FolderEntry& entry, int column) const;
    void take(const FolderEntry& clicked, ActionQueue& ask);
    void remember_folder(ActionQueue& ask, const std::filesystem::path& file) const;
    void open(ActionQueue& ask, const std::filesystem::path& file) const;
    void draw_open(Ui& ui, const FrameState& now, ActionQueue& ask);
    void draw_save(Ui& ui, const FrameState& now, ActionQueue& ask);
    bool draw_save_button(Ui& ui, const widgets::Permission& allowed, const std::filesystem::path& replaced);
    void draw_cancel(Ui& ui, const FrameState& now, ActionQueue& ask) const;
    [[nodiscard]] std::filesystem::path file_to_save(std::string_view name) const;
    [[nodiscard]] bool replaces(const std::filesystem::path& file, const FrameState& now) const;

    actions::FilePrompt asked_ = actions::FilePrompt::none;
    Source source_ = Source::folder;
    std::filesystem::path folder_;
    std::vector<FolderEntry> entries_;
    std::size_t filter_ = 0;       ///< of filters_of()
    bool to_top_ = false;          ///< the list shows its beginning in the next frame
    std::string fault_;            ///< why the folder cannot be read
    std::filesystem::path chosen_; ///< of the entries; empty: none
    std::string name_;             ///< typed for saving
    std::filesystem::path named_;  ///< by the button as one that it replaces; empty: none
    bool answered_ = false;        ///< a name, in the last frame: still being asked, it was refused
    ProjectPreview preview_;
};

} // namespace millwright::panels
