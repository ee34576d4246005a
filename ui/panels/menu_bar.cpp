#include "ui/panels/menu_bar.h"

#include "core/project/assets.h"
#include "ui/widgets/icons.h"
#include "ui/widgets/menus.h"

#include <algorithm>
#include <array>
#include <string>

namespace millwright::panels {

namespace {

namespace icons = widgets::icons;
using actions::Workspace;

constexpr std::array<std::string_view, 5> menus{"File", "Edit", "View", "Grid", "Machine"};

constexpr std::array<widgets::Option, actions::workspace_count> workspaces{
    {{"design", "Design", icons::design},
     {"grid", "Grid", icons::grid},
     {"toolpath", "Toolpath", icons::toolpath},
     {"program", "Program", icons::program},
     {"machine", "Machine", icons::machine}}};

std::string widget_id(std::string_view action_id) {
    std::string id(action_id);
    std::replace(id.begin(), id.end(), '.', '_');
    return id;
}

std::string lower(std::string_view word) {
    std::string result(word);
    std::transform(result.begin(), result.end(), result.begin(), [](unsigned char c) {
        return static_cast<char>(std::tolower(c));
    });
    return result;
}

} // namespace

void MenuBar::draw(Ui& ui, const Workbench& now, ActionQueue& ask) {
    draw_menus(ui, now, ask);
    ui.beside();
    if (const auto chosen = ui.tabs("workspaces", static_cast<int>(now.session.workspace), workspaces)) {
        ask.show([w = static_cast<Workspace>(*chosen)](actions::Session& session) { session.workspace = w; });
    }
}

void MenuBar::draw_menus(Ui& ui, const Workbench& now, ActionQueue& ask) const {
    for (const std::string_view title : menus) {
        if (title != menus.front()) {
            ui.beside();
        }
        const auto open = widgets::menu(ui, lower(title), title);
        if (!open) {
            continue;
        }
        for (const auto& action : catalogue_.all()) {
            const actions::ActionInfo& info = action->info();
            if (info.menu == title &&
                widgets::menu_item(
                    ui, widget_id(info.id), info.title, info.shortcut, action->permission(now))) {
                ask.run(std::string(info.id));
            }
        }
        if (title == "File") {
            draw_samples(ui, now, ask);
        }
    }
}

void MenuBar::draw_samples(Ui& ui, const Workbench& now, ActionQueue& ask) const {
    widgets::menu_line(ui);
    for (const std::filesystem::path& sample : project::sample_projects(now.assets)) {
        if (widgets::menu_item(ui, "sample_" + sample.stem().string(), "Sample: " + sample.stem().string())) {
            ask.open_file(sample);
        }
    }
    if (now.document.recent.empty()) {
        return;
    }
    widgets::menu_line(ui);
    int n = 0;
    for (const std::filesystem::path& file : now.document.recent) {
        if (widgets::menu_item(ui, "recent_" + std::to_string(++n), file.filename().string())) {
            ask.open_file(file);
        }
    }
}

} // namespace millwright::panels
