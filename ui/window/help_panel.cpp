#include "ui/window/help_panel.h"

#include "core/project/version.h"
#include "ui/render/imgui_compat.h"
#include "ui/window/manual.h"

#include <algorithm>
#include <array>

namespace millwright::panels {

namespace {

using actions::HelpPage;
using widgets::ReadingBlock;
using widgets::ReadingKind;

constexpr std::array<HelpPage, 4> page_order{
    HelpPage::workspace, HelpPage::keys, HelpPage::commands, HelpPage::about};
constexpr std::array<widgets::Option, 4> help_topics{{{"workspace", "This workspace"},
                                                      {"keys", "Shortcuts"},
                                                      {"commands", "PMAC commands"},
                                                      {"about", "About"}}};

/// Of whatever has one, as the menus have it.
std::vector<ReadingBlock> keys_of(const actions::Catalogue& catalogue) {
    std::vector<ReadingBlock> rows{{ReadingKind::head_row, {"Key", "Action", "Menu"}}};
    for (const auto& action : catalogue.all()) {
        const actions::ActionInfo& info = action->info();
        if (!info.shortcut.empty()) {
            std::string keys(info.shortcut);
            keys += info.second_shortcut.empty() ? "" : ", " + std::string(info.second_shortcut);
            rows.push_back({ReadingKind::row, {keys, std::string(info.title), std::string(info.menu)}});
        }
    }
    rows.push_back({ReadingKind::paragraph,
                    {"Find all other commands with the command search (Ctrl+K) or in the menus. Keys for "
                     "jogging are described with their workspaces."}});
    return rows;
}

std::vector<ReadingBlock> about_page() {
    return {{ReadingKind::heading, {"Millwright " + std::string(project::version())}},
            {ReadingKind::paragraph,
             {"From a surface, a plot or a picture to a machined part: toolpaths with the actual error of "
              "the machine, programs, controllers and their emulators, a robot arm, a CORDIC processor."}},
            {ReadingKind::paragraph,
             {"Free software under the GNU General Public License, version 3 or later, without any warranty. "
              "Inspect the machine before you move it."}},
            {ReadingKind::paragraph,
             {"The complete manual is in the docs folder of the source code; these pages are part of it."}}};
}

std::vector<ReadingBlock> page(HelpPage wanted, actions::Workspace workspace, const actions::Catalogue& all) {
    switch (wanted) {
    case HelpPage::keys:
        return keys_of(all);
    case HelpPage::commands:
        return manual_of_commands();
    case HelpPage::about:
        return about_page();
    default:
        return manual_of(workspace);
    }
}

} // namespace

void HelpPanel::refresh(const FrameState& now) {
    if (shown_ != now.view_state.help || workspace_ != now.view_state.workspace) {
        shown_ = now.view_state.help;
        workspace_ = now.view_state.workspace;
        blocks_ = page(shown_, workspace_, catalogue_);
    }
}

void HelpPanel::draw(Ui& ui, const FrameState& now, ActionQueue& ask) {
    constexpr float widest = 900.0F, margin = 80.0F, share = 0.6F;
    refresh(now);
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const auto dialog = ui.dialog("help", "Help", std::min(ui.px(widest), display.x - ui.px(margin)));
    if (!dialog) {
        return;
    }
    const bool again = render::key_pressed(render::Key::f1);
    const auto at = std::ranges::find(page_order, now.view_state.help) - page_order.begin();
    if (const auto chosen = ui.tabs("pages", static_cast<int>(at), help_topics)) {
        ask.show([wanted = page_order[static_cast<std::size_t>(*chosen)]](actions::ViewState& view_state) {
            view_state.help = wanted;
        });
    }
    const std::string name(help_topics[static_cast<std::size_t>(at)].id);
    widgets::reading(
        ui, "text", name + std::to_string(static_cast<int>(workspace_)), blocks_, share * display.y);
    ui.gap();
    const auto width = ui.width(ui.px(120.0F));
    if (ui.button("close", "Close", {}, {{}, widgets::Rank::primary, -1.0F, "Esc"}) || ui.escape_pressed() ||
        again) {
        ask.show([](actions::ViewState& view_state) { view_state.help = HelpPage::none; });
    }
}

} // namespace millwright::panels
