#include "ui/window/menu_bar.h"

#include "core/project/assets.h"
#include "ui/panels/layer_list.h"
#include "ui/widgets/icons.h"
#include "ui/widgets/menus.h"

#include <algorithm>
#include <array>
#include <string>

namespace millwright::panels {

namespace {

namespace icons = widgets::icons;
using actions::Workspace;

constexpr std::array<std::string_view, 9> menus{
    "File", "Edit", "View", "Grid", "Machine", "Processor", "Plot", "Arm", "Help"};

constexpr std::array<widgets::Option, actions::workspace_count> workspaces{
    {{"design", "Design", icons::design},
     {"grid", "Grid", icons::grid},
     {"toolpath", "Toolpath", icons::toolpath},
     {"program", "Program", icons::program},
     {"machine", "Machine", icons::machine},
     {"processor", "Processor", icons::processor},
     {"plot", "Plot", icons::plot},
     {"arm", "Arm", icons::arm}}};

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

constexpr float gap_to_stop = 12.0F; // from the search to the emergency stop
constexpr float tools_width = 300.0F;
constexpr float narrow_tools = 154.0F; // the search without its name
constexpr float least_tabs = 120.0F;   // those without room are behind a button
constexpr float roomy = 940.0F;        // tabs with icons, and the tools

/// There is room for those that are wanted in a workspace; everything is in the palette.
bool has_room(std::string_view menu, Workspace workspace) {
    const bool processor = workspace == Workspace::processor, plot = workspace == Workspace::plot,
               arm = workspace == Workspace::arm;
    return menu == "Processor" ? processor
           : menu == "Plot"    ? plot
           : menu == "Arm"     ? arm
           : menu == "Grid"    ? !processor && !plot && !arm
           : menu == "Machine" ? !processor
                               : true;
}

/// Of the menus of a workspace with what is between them, px.
float menus_width(const Ui& ui, Workspace workspace) {
    float width = 0.0F;
    for (const std::string_view title : menus) {
        width +=
            has_room(title, workspace) ? widgets::menu_width(ui, title) + ui.px(widgets::gaps::small) : 0.0F;
    }
    return width;
}

/// The tabs keep their places where a workspace has fewer menus.
float room_for_other_menus(const Ui& ui, Workspace workspace) {
    float most = 0.0F;
    for (int n = 0; n < actions::workspace_count; ++n) {
        most = std::max(most, menus_width(ui, static_cast<Workspace>(n)));
    }
    return most - menus_width(ui, workspace);
}

/// Actions that are behind one row of their menu.
struct Submenu {
    std::string_view id, label;
    std::string_view first; ///< of its actions; the row stands in its place
    bool (*holds)(std::string_view action_id);
};

bool is_of_side(std::string_view id) {
    return id.starts_with("view.from_") || id == "view.into_space" || id == "view.oblique";
}

constexpr std::array<Submenu, 4> submenus{
    {{"workspace",
      "Workspace",
      "view.design",
      [](std::string_view id) {
          constexpr std::string_view view = "view.";
          return id.starts_with(view) && std::ranges::any_of(workspaces, [&](const widgets::Option& option) {
                     return id.substr(view.size()) == option.id;
                 });
      }},
     {"path_shown",
      "Path shown",
      "view.show_uniform",
      [](std::string_view id) { return id.starts_with("view.show_"); }},
     {"look_from", "View direction", "view.from_above", is_of_side},
     {"program_from", "Program grid", "grid.use_uniform", [](std::string_view id) {
          return id.starts_with("grid.use_");
      }}}};

const Submenu* submenu_of(std::string_view action_id) {
    const auto* const found =
        std::ranges::find_if(submenus, [action_id](const Submenu& sub) { return sub.holds(action_id); });
    return found == submenus.end() ? nullptr : found;
}

void draw_item(Ui& ui, const FrameState& now, ActionQueue& ask, const actions::Action& action) {
    const actions::ActionInfo& info = action.info();
    if (widgets::menu_item(
            ui, widget_id(info.id), info.title, info.shortcut, action.permission(now), action.is_on(now))) {
        ask.run(std::string(info.id));
    }
}

/// A line stands above these in their menu.
bool begins_group(std::string_view id) {
    constexpr std::array<std::string_view, 15> first{"file.save",
                                                     "file.import",
                                                     "file.write_program",
                                                     "file.quit",
                                                     "edit.select_all",
                                                     "edit.smooth",
                                                     "view.show_uniform",
                                                     "view.fit",
                                                     "view.outline",
                                                     "view.theme",
                                                     "grid.play",
                                                     "grid.use_uniform",
                                                     "processor.thesis_arc",
                                                     "processor.take_over",
                                                     "work.cancel"};
    return std::find(first.begin(), first.end(), id) != first.end();
}

} // namespace

void MenuBar::draw(Ui& ui, const FrameState& now, ActionQueue& ask) {
    constexpr float left = 12.0F;
    constexpr float top = 10.0F;
    constexpr float tabs_above = 2.0F; // they are that much higher than the rest of the bar
    ui.move_by(ui.px(left), ui.px(top));
    draw_menus(ui, now, ask);
    ui.beside();
    ui.move_by(room_for_other_menus(ui, now.view_state.workspace), -ui.px(tabs_above));
    const bool narrow = ui.rest().w < ui.px(roomy);
    const float tools = ui.px(narrow ? narrow_tools : tools_width);
    auto shown = workspaces;
    for (widgets::Option& option : shown) {
        option.icon = narrow ? std::string_view() : option.icon;
    }
    {
        const auto width = ui.width(std::max(ui.rest().w - tools, ui.px(least_tabs)));
        if (const auto chosen = ui.tabs("workspaces", static_cast<int>(now.view_state.workspace), shown)) {
            ask.show([w = static_cast<Workspace>(*chosen)](actions::ViewState& view_state) {
                view_state.workspace = w;
            });
        }
    }
    ui.beside();
    ui.move_by(0.0F, ui.px(tabs_above));
    draw_tools(ui, now, ask);
}

/// What is wanted often, by icon, and the way to everything else.
void MenuBar::draw_tools(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    for (const std::string_view id : {"file.save", "edit.undo", "edit.redo"}) {
        const actions::Action& action = catalogue_.find(id);
        const actions::ActionInfo& info = action.info();
        const std::string what = id == "edit.undo" && !now.undo_title.empty()   ? "Undo: " + now.undo_title
                                 : id == "edit.redo" && !now.redo_title.empty() ? "Redo: " + now.redo_title
                                                                                : std::string(info.title);
        if (ui.icon_button(widget_id(id),
                           info.icon,
                           what + " (" + std::string(info.shortcut) + ")",
                           action.permission(now))) {
            ask.run(std::string(id));
        }
        ui.beside();
    }
    constexpr float named = 130.0F;
    const float room = ui.rest().w - ui.px(gap_to_stop);
    const auto width = ui.width(room);
    const bool asked = room < ui.px(named)
                           ? ui.icon_button("search", icons::search, "Search commands (Ctrl+K)")
                           : ui.button("search",
                                       "Search  Ctrl+K",
                                       {},
                                       {icons::search, widgets::Rank::normal, -1.0F, "Search commands"});
    if (asked) {
        ask.run("view.search");
    }
}

void MenuBar::draw_menus(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    for (const std::string_view title : menus) {
        if (!has_room(title, now.view_state.workspace)) {
            continue;
        }
        if (title != menus.front()) {
            ui.beside();
        }
        const auto open = widgets::menu(ui, lower(title), title);
        if (!open) {
            continue;
        }
        for (const auto& action : catalogue_.all()) {
            const actions::ActionInfo& info = action->info();
            if (info.menu != title || info.id == "view.colors") { // which is with the layers
                continue;
            }
            if (info.id == "file.quit") {
                draw_files(ui, now, ask);
            }
            const Submenu* sub = submenu_of(info.id);
            if (begins_group(info.id)) {
                widgets::menu_line(ui);
            }
            if (sub == nullptr) {
                draw_item(ui, now, ask, *action);
            } else if (info.id == sub->first) {
                draw_submenu(ui, now, ask, sub->id, sub->label, sub->holds);
            }
        }
        if (title == "View") {
            if (const auto layers = widgets::submenu(ui, "layers", "Layers")) {
                layer_rows(ui, now, ask, catalogue_);
            }
        }
    }
}

void MenuBar::draw_submenu(Ui& ui,
                           const FrameState& now,
                           ActionQueue& ask,
                           std::string_view id,
                           std::string_view label,
                           bool (*holds)(std::string_view action_id)) const {
    if (const auto open = widgets::submenu(ui, id, label)) {
        for (const auto& action : catalogue_.all()) {
            if (holds(action->info().id)) {
                draw_item(ui, now, ask, *action);
            }
        }
    }
}

void MenuBar::draw_files(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    widgets::menu_line(ui);
    if (const auto samples = widgets::submenu(ui, "samples", "Open a sample")) {
        for (const std::filesystem::path& sample : project::sample_projects(now.assets)) {
            const std::string name = sample.stem().string();
            if (widgets::menu_item(ui, "sample_" + name, name)) {
                ask.open_file(sample);
            }
        }
    }
    if (now.recent.empty()) {
        return;
    }
    if (const auto recent = widgets::submenu(ui, "recent", "Open recent")) {
        int n = 0;
        for (const std::filesystem::path& file : now.recent) {
            if (widgets::menu_item(ui,
                                   "recent_" + std::to_string(++n),
                                   file.filename().string(),
                                   file.parent_path().filename().string())) {
                ask.open_file(file);
            }
        }
    }
}

} // namespace millwright::panels
