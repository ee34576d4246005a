#include "tests/ui/widgets/gallery.h"

#include "core/base/text.h"

#include <array>
#include <cmath>

namespace millwright::test {

using namespace widgets;

namespace {

constexpr FieldInfo nodes_info{.id = "nu",
                               .label = "Nodes along u",
                               .unit = "",
                               .tip = "Number of cutter contact points along u, 2 to 400.",
                               .min = 2,
                               .max = 400,
                               .default_value = 20,
                               .decimals = 0};
constexpr FieldInfo radius_info{.id = "radius",
                                .label = "Cutter radius",
                                .unit = "mm",
                                .tip = "Radius of the ball, 0.1 to 50 mm.",
                                .min = 0.1,
                                .max = 50,
                                .default_value = 3,
                                .decimals = 3};
constexpr FieldInfo feed_info{.id = "feed",
                              .label = "Feed",
                              .unit = "mm/min",
                              .tip = "Speed of the tip on the part.",
                              .min = 1,
                              .max = 20000,
                              .default_value = 1200,
                              .decimals = 0};
constexpr FieldInfo point_info{
    .id = "point", .label = "Point", .unit = "mm", .tip = "In the part's frame.", .decimals = 2};
constexpr FieldInfo max_info{.id = "max", .label = "Max", .unit = "mm", .tip = ""};

/// A few points of viridis.
Colour viridis(double t) {
    constexpr std::array<Colour, 5> points{
        rgb(0x440154), rgb(0x3B528B), rgb(0x21918C), rgb(0x5EC962), rgb(0xFDE725)};
    const double at = std::min(std::max(t, 0.0), 1.0) * 4.0;
    const auto i = std::min<std::size_t>(3, static_cast<std::size_t>(at));
    return mixed(points[i], points[i + 1], at - static_cast<double>(i));
}

std::string program_line(std::ptrdiff_t i) {
    if (i == 0) {
        return "(dome, 20 x 20 nodes, optimised tracks)";
    }
    if (i == 1) {
        return "G21 G90 G94";
    }
    const auto n = static_cast<double>(i);
    return "N" + std::to_string(10 * i) + " G1 X" + fixed(50.0 * std::sin(n / 9.0), 3) + " Y" +
           fixed(n / 7.0, 3) + " Z" + fixed(20.0 * std::cos(n / 9.0), 3) + " A" + fixed(n / 10.0, 3) +
           " F1200";
}

} // namespace

Gallery::Gallery() {
    for (int i = 0; i < 4000; ++i) {
        const double s = i / 4000.0;
        path_mm_.push_back(1964.0 * s);
        error_mm_.push_back(0.4 * std::abs(std::sin(31.4 * s)) * (0.3 + s * (1.0 - s)));
        feed_.push_back(1200.0 - 700.0 * std::pow(std::abs(std::cos(31.4 * s)), 20.0));
    }
    for (int i = 1; i <= 60; ++i) {
        iteration_.push_back(i);
        norm_.push_back(3.0 * std::exp(-0.2 * i) + 1e-5);
    }
    toasts.push({Severity::good, "Saved the project.", "assets/projects/dome.json"});
    toasts.push({Severity::danger,
                 "The machine file has no axis that turns the table.",
                 "assets/machines/broken.json:14:9"});
}

void Gallery::draw(Ui& ui) {
    draw_menu_bar(ui);
    draw_outline(ui);
    draw_view(ui);
    draw_inspector(ui);
    draw_bottom(ui);
    draw_status(ui);
    splitter(
        ui,
        "splitter",
        {.bar = {ui.px(239.0F), ui.px(40.0F), ui.px(2.0F), ui.px(490.0F)}, .size = 240.0F, .max = 400.0F});
    toasts.draw(ui, "notices", {0.0F, 0.0F, ui.px(960.0F), ui.px(520.0F)});
    const std::array<SearchItem, 5> items{
        SearchItem{"grid.adapt", "Adapt the grid", "Grid", "Ctrl+G"},
        SearchItem{"file.save", "Save", "File", "Ctrl+S"},
        SearchItem{"view.top", "View from the top", "View", "7"},
        SearchItem{
            "job.run", "Run the program", "Machine", "F9", Permission::refused("No machine is connected.")},
        SearchItem{"grid.reset", "Back to the uniform grid", "Grid"}};
    search.draw(ui, "palette", items);
}

void Gallery::draw_menu_bar(Ui& ui) {
    const auto pane = ui.bare_pane("bar", {0.0F, 0.0F, ui.px(1280.0F), ui.px(38.0F)});
    ui.move_by(ui.px(8.0F), ui.px(6.0F));
    for (const std::string_view word : {"File", "Edit", "View", "Help"}) {
        if (const auto list = menu(ui, word, word)) {
            menu_item(ui, "open", "Open a project ...", "Ctrl+O");
            menu_item(ui, "save", "Save", "Ctrl+S", Permission::refused("Nothing has changed."));
            menu_line(ui);
            menu_item(ui, "axes", "Show the axes", "", {}, true);
        }
        ui.beside();
    }
    const std::array<Option, 5> spaces{Option{"design", "Design"},
                                       Option{"grid", "Grid"},
                                       Option{"toolpath", "Toolpath"},
                                       Option{"program", "Program"},
                                       Option{"machine", "Machine"}};
    const auto width = ui.width(ui.px(560.0F));
    ui.segmented("workspace", "", 1, spaces);
    ui.beside();
    ui.button("search", "Search", {}, {.icon = icons::search, .width = ui.px(200.0F)});
    ui.beside();
    ui.icon_button("undo", icons::undo, "Undo");
    ui.beside();
    ui.icon_button("redo", icons::redo, "Redo", Permission::refused("Nothing to redo."));
}

void Gallery::draw_outline(Ui& ui) {
    const auto pane = ui.pane("outline", {0.0F, ui.px(40.0F), ui.px(239.0F), ui.px(490.0F)}, "Project");
    const std::array<Option, 2> pages{Option{"tree", "Outline"}, Option{"layers", "Layers"}};
    ui.tabs("pages", 1, pages);
    ui.checkbox("surface", "Surface", true);
    ui.checkbox("net", "Control net", true);
    ui.checkbox("grid", "Grid", false);
    ui.checkbox("machine", "Machine", false, "", Permission::refused("There is no machine yet."));
    ui.toggle("live", "Follow live", true);
    ui.toggle("shadow", "Shadows", false);
    ui.gap();
    readout(ui,
            "position",
            std::array<AxisReading, 3>{AxisReading{"X", -12.3456, "mm", 3},
                                       AxisReading{"Z", 148.2, "mm", 3, {}, AxisState::near_limit},
                                       AxisReading{"A", 31.4, "°", 3, {}, AxisState::beyond_limit}});
}

void Gallery::draw_view(Ui& ui) {
    const Rect area{ui.px(241.0F), ui.px(40.0F), ui.px(719.0F), ui.px(490.0F)};
    const auto pane = ui.bare_pane("view", area);
    canvas(ui, "scene", area, 0);
    label_at(ui, {area.x + ui.px(300.0F), area.y + ui.px(200.0F)}, "X", ui.colours().axis[0]);
    legend(ui,
           "legend",
           {area.right() - ui.px(104.0F), area.y + ui.px(12.0F), ui.px(92.0F), ui.px(250.0F)},
           {.title = "Error",
            .unit = "mm",
            .low = 0.0,
            .high = 0.25,
            .map = viridis,
            .over = ui.colours().danger});
}

void Gallery::draw_inspector(Ui& ui) {
    const auto pane =
        ui.pane("inspector", {ui.px(962.0F), ui.px(40.0F), ui.px(318.0F), ui.px(490.0F)}, "Grid");
    ui.integer(24, nodes_info);
    ui.number(3.0, radius_info);
    ui.number(1200.0, feed_info, Permission::refused("The feed comes from the machine."));
    ui.vec3("point", "Point", {-50.0, 12.5, 148.25}, point_info);
    const std::array<Option, 3> methods{
        Option{"uniform", "Uniform"}, Option{"elliptic", "Elliptic"}, Option{"tracks", "Tracks"}};
    ui.choice("method", "Method", 2, methods);
    ui.segmented(
        "ends", "Boundary", 0, std::array<Option, 2>{Option{"fixed", "Fixed"}, Option{"sliding", "Sliding"}});
    ui.expression("weight", "Weight", "1 + 4*e/h^2", [](std::string_view) { return std::string(); });
    ui.text_field("name", "Name", "Dome");
    {
        const auto row = ui.row(2);
        ui.button("adapt", "Adapt", {}, {.icon = icons::play, .rank = Rank::primary});
        ui.button("reset", "Reset", Permission::refused("The grid is as it was."));
    }
    if (const auto section = ui.section("error", "Error")) {
        ui.value("mean", 0.0123, {.id = "mean", .label = "Mean", .unit = "mm", .tip = ""});
        ui.value("max", 0.2417, max_info);
        ui.value("machine", "Machine", "Rotary-tilt");
    }
    ui.progress("work", "Adapting the grid", 0.62);
    banner(ui,
           "pole",
           {Severity::warning, "Two nodes lie at a pole of the machine: the C axis spins there.", "Track 7"});
}

void Gallery::draw_bottom(Ui& ui) {
    {
        const auto pane = ui.pane("time", {0.0F, ui.px(532.0F), ui.px(1280.0F), ui.px(94.0F)});
        const std::array<TimelineSeries, 2> series{TimelineSeries{"Error", "mm", error_mm_},
                                                   TimelineSeries{"Feed", "mm/min", feed_}};
        timeline(ui,
                 "timeline",
                 {.fraction = 0.27,
                  .block = 1204,
                  .blocks = 4410,
                  .time_s = 192.0,
                  .total_s = 700.0,
                  .series = series});
    }
    {
        const auto pane = ui.pane("plots", {0.0F, ui.px(628.0F), ui.px(420.0F), ui.px(144.0F)});
        const std::array<Series, 2> series{Series{"Error", path_mm_, error_mm_, 0, true},
                                           Series{"Norm", iteration_, norm_}};
        line_plot(ui,
                  "error",
                  {.x_label = "Path",
                   .x_unit = "mm",
                   .y_label = "Error",
                   .y_unit = "mm",
                   .series = std::span(series).first(1),
                   .cursor_x = 530.0,
                   .limit_y = 0.15});
    }
    {
        const auto pane =
            ui.bare_pane("program", {ui.px(422.0F), ui.px(628.0F), ui.px(420.0F), ui.px(144.0F)});
        listing(
            ui, "lines", {.lines = 4410, .line = program_line, .current = 3, .mark = [](std::ptrdiff_t i) {
                              return viridis(static_cast<double>(i % 9) / 9.0);
                          }});
    }
    const auto pane = ui.pane("compare", {ui.px(844.0F), ui.px(628.0F), ui.px(436.0F), ui.px(144.0F)});
    constexpr std::array columns{Column{"Result", "", 1.6F},
                                 Column{"Max", "mm", 1.0F, true},
                                 Column{"Mean", "mm", 1.0F, true},
                                 Column{"Time", "", 1.2F, true}};
    const std::array<std::array<std::string, 4>, 3> cells{{{"Uniform", "0.2417", "0.0412", "00:11:40"},
                                                           {"Elliptic", "0.1711", "0.0383", "00:11:52"},
                                                           {"Tracks", "0.0322", "0.0123", "00:11:31"}}};
    table(ui,
          "results",
          {.columns = columns,
           .rows = 3,
           .cell = [&](std::ptrdiff_t r,
                       int c) { return cells[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)]; },
           .row_id = [&](std::ptrdiff_t r) { return cells[static_cast<std::size_t>(r)][0]; },
           .chosen = 2});
}

void Gallery::draw_status(Ui& ui) {
    const auto pane = ui.bare_pane("status", {0.0F, ui.px(774.0F), ui.px(1280.0F), ui.px(26.0F)});
    ui.move_by(ui.px(12.0F), 0.0F);
    ui.words("Virtual machine");
    ui.beside();
    ui.words("idle", Tone::good);
    ui.beside();
    ui.move_by(ui.px(24.0F), 0.0F);
    ui.words("X -12.346  Y 40.000  Z 148.200 mm", Tone::muted);
}

} // namespace millwright::test
