// What there is to read about the program.
#include "ui/actions/internal/simple_action.h"

namespace millwright::actions {

namespace {

template <HelpPage page> void open(ActionContext& context) {
    context.view_state.help = page;
}

} // namespace

void add_help_actions(Actions& actions) {
    constexpr std::string_view menu = "Help";
    namespace icons = widgets::icons;
    add(actions,
        {"help.workspace",
         menu,
         "Help on this workspace",
         "Shows the manual page of this workspace.",
         "F1",
         icons::info},
        always,
        open<HelpPage::workspace>);
    add(actions,
        {"help.keys", menu, "Keyboard shortcuts", "Lists the keyboard shortcuts.", "", icons::keyboard},
        always,
        open<HelpPage::keys>);
    add(actions,
        {"help.commands",
         menu,
         "PMAC command reference",
         "Lists the on-line commands of the arm's card.",
         "",
         icons::program},
        always,
        open<HelpPage::commands>);
    add(actions,
        {"help.about", menu, "About Millwright", "Shows the version and the licence.", "", icons::info},
        always,
        open<HelpPage::about>);
}

} // namespace millwright::actions
