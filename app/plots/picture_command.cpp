#include "app/plots/picture_command.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

namespace millwright::app {

void add_picture_command(CLI::App& app, Command& chosen) {
    CLI::App& group = *app.add_subcommand("picture", "Turn a picture into toolpaths");
    group.require_subcommand(1);
    add_picture_carve(group, chosen);
    add_picture_engrave(group, chosen);
    add_picture_relief(group, chosen);
    add_picture_trace(group, chosen);
}

} // namespace millwright::app
