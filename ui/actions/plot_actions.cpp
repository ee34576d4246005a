#include "ui/actions/app_controller.h"
#include "ui/actions/internal/simple_action.h"

namespace millwright::actions {

namespace icons = widgets::icons;

namespace {

using widgets::Permission;

Permission has_path(const FrameState& now) {
    const auto made = now.plot.latest();
    if (now.plot.file().empty()) {
        return Permission::refused("Open a plot or a picture first.");
    }
    if (!made || !made->finished || !now.plot.is_current(*made)) {
        return Permission::refused(now.plot.given_up() ? "The computation of the path was cancelled."
                                                       : "The path is still being computed.");
    }
    return made->path && !made->failure
               ? Permission{}
               : Permission::refused(made->failure ? to_text(*made->failure) : "There is no path.");
}

Permission can_send_plot(const FrameState& now) {
    return now.job.running ? Permission::refused("A job is running.") : has_path(now);
}

Permission has_path_without_points(const FrameState& now) {
    const Permission path = has_path(now);
    return path.allowed && now.plot.latest()->points
               ? Permission::refused("The file already contains points.")
               : path;
}

Permission can_play_plot(const FrameState& now) {
    if (const Permission path = has_path(now); !path.allowed) {
        return path;
    }
    const TableView table = now.plot.table().view();
    if (table.playing && table.status.state == drivers::PlayState::holding) {
        return Permission::refused("The table is held. Press Resume to continue.");
    }
    return table.playing ? Permission::refused("The table is moving.") : Permission{};
}

Permission is_table_moving(const FrameState& now) {
    return now.plot.table().playing() ? Permission{} : Permission::refused("The table is not moving.");
}

template <drivers::PlayState state> Permission table_is(const FrameState& now) {
    const TableView table = now.plot.table().view();
    const bool is = table.playing && table.status.state == state;
    return is ? Permission{}
              : Permission::refused(state == drivers::PlayState::playing ? "The table is not moving."
                                                                         : "The table is not held.");
}

template <render::StandardView side> void look(ActionContext& context) {
    context.view_state.workspace = Workspace::plot;
    context.view_state.side_wanted = side;
}

void add_plot_views(Actions& actions) {
    constexpr std::string_view menu = "Plot";
    add(actions,
        {"plot.flat", menu, "Top view", "Shows the drawing as it lies on the table.", "", ""},
        always,
        look<render::StandardView::top>);
    add(actions,
        {"plot.space", menu, "Isometric view", "Shows depths and travel.", "", ""},
        always,
        look<render::StandardView::iso>);
    add(
        actions,
        {"plot.light",
         menu,
         "Backlit preview",
         "Shows the light that passes through the finished plate, as with black plastic.",
         "",
         ""},
        always,
        [](ActionContext& context) { context.view_state.against_light = !context.view_state.against_light; },
        [](const FrameState& now) { return now.view_state.against_light; });
    add(
        actions,
        {"plot.picture",
         menu,
         "Show picture below path",
         "Shows the picture with its toolpath on top.",
         "",
         ""},
        [](const FrameState& now) {
            const auto made = now.plot.latest();
            return made && made->shown_picture ? Permission{} : Permission::refused("No picture is open.");
        },
        [](ActionContext& context) { context.view_state.picture_shown = !context.view_state.picture_shown; },
        [](const FrameState& now) { return now.view_state.picture_shown; });
}

void add_plot_files(Actions& actions) {
    constexpr std::string_view menu = "Plot";
    add(actions,
        {"plot.write_program",
         menu,
         "Write G-code",
         "Writes it next to the plot, or to your own folder if the plot ships with Millwright; no other file "
         "is replaced.",
         "",
         icons::save},
        has_path,
        [](ActionContext& context) { context.app.write_plot(false); });
    add(actions,
        {"plot.write_path",
         menu,
         "Write path",
         "Writes a path file of X, Y, Z and speed next to the plot, or to your own folder; no other file is "
         "replaced.",
         "",
         icons::save},
        has_path,
        [](ActionContext& context) { context.app.write_plot_path(); });
    add(actions,
        {"plot.write_points",
         menu,
         "Write points",
         "Writes a file of the points that are sent to the table, one per period, next to the plot, or to "
         "your own folder; no other file is replaced.",
         "",
         icons::save},
        has_path_without_points,
        [](ActionContext& context) { context.app.write_plot_points(); });
    add(actions,
        {"plot.to_machine",
         menu,
         "Open in Machine workspace",
         "Writes the G-code and opens it in the Machine workspace, where it can be sent or queued.",
         "",
         icons::machine},
        can_send_plot,
        [](ActionContext& context) { context.app.write_plot(true); });
}

void add_plot_table(Actions& actions) {
    constexpr std::string_view menu = "Plot";
    add(actions,
        {"plot.play_table",
         menu,
         "Play on the table",
         "Sends the displayed path, one point per period at constant velocity.",
         "",
         icons::play},
        can_play_plot,
        [](ActionContext& context) {
            context.view_state.playback.playing = false;
            context.app.plot().play_table(context.view_state.playback.time);
        });
    add(actions,
        {"plot.hold_table",
         menu,
         "Hold the table",
         "Sends no further point until you resume.",
         "",
         icons::hold},
        table_is<drivers::PlayState::playing>,
        [](ActionContext& context) { context.app.plot().table().hold(); });
    add(actions,
        {"plot.resume_table",
         menu,
         "Resume the table",
         "Continues with the next point, for example after a tool change.",
         "",
         icons::play},
        table_is<drivers::PlayState::holding>,
        [](ActionContext& context) { context.app.plot().table().resume(); });
    add(actions,
        {"plot.stop_table", menu, "Stop the table", "Sends no more points.", "", icons::stop},
        is_table_moving,
        [](ActionContext& context) { context.app.plot().table().stop(); });
}

} // namespace

void add_plot_actions(Actions& actions) {
    add_plot_views(actions);
    add_plot_files(actions);
    add_plot_table(actions);
}

} // namespace millwright::actions
