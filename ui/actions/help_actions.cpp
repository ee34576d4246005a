// What there is to read about the program.
#include "ui/actions/internal/simple_action.h"

namespace millwright::actions {

namespace {

template <HelpPage page> void open(Hands& hands) {
    hands.session.help = page;
}

} // namespace

void add_help_actions(Actions& actions) {
    constexpr std::string_view menu = "Help";
    namespace icons = widgets::icons;
    add(actions,
        {"help.workspace", menu, "This workspace", "What the manual says of it.", "F1", icons::info},
        always,
        open<HelpPage::workspace>);
    add(actions,
        {"help.keys", menu, "Keys", "What can be done by a key.", "", icons::keyboard},
        always,
        open<HelpPage::keys>);
    add(actions,
        {"help.commands",
         menu,
         "Commands of a PMAC",
         "The on-line commands of the arm's card.",
         "",
         icons::program},
        always,
        open<HelpPage::commands>);
    add(actions,
        {"help.about", menu, "About Millwright", "Which version this is, and its licence.", "", icons::info},
        always,
        open<HelpPage::about>);
}

} // namespace millwright::actions
