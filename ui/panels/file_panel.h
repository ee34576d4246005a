// Choosing a file to open or to save to: the folder's project files, a field for the path.
#pragma once

#include "ui/panels/panel.h"

#include <filesystem>
#include <string>
#include <vector>

namespace millwright::panels {

class FilePanel final : public Panel {
public:
    void draw(Ui& ui, const Workbench& now, ActionQueue& ask) override;

private:
    void enter(const std::filesystem::path& folder);
    void draw_recent(Ui& ui, const Workbench& now, ActionQueue& ask) const;
    void draw_folder(Ui& ui, const Workbench& now, ActionQueue& ask);
    void choose(const std::filesystem::path& file, const Workbench& now, ActionQueue& ask) const;

    std::filesystem::path folder_; ///< empty until the first draw
    std::vector<std::filesystem::path> entries_;
    std::string fault_; ///< why the folder cannot be read
    std::string name_;  ///< typed for saving
};

} // namespace millwright::panels
