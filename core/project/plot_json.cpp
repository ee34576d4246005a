#include "core/project/internal/plot_json.h"

#include "core/project/internal/setting_json.h"
#include "core/project/plot_settings.h"

namespace millwright::project {

namespace {

plot::Level level_of(const JsonValue& value) {
    expect_fields<plot::Level>(value, level_numbers(), {"pen", "enabled"});
    plot::Level level = PlotSettings{}.level;
    level.pen = value.at("pen").integer();
    read_flag(value, "enabled", level.enabled);
    read_numbers<plot::Level>(value, level_numbers(), level);
    return level;
}

Json json_of(const plot::Level& level) {
    Json json;
    json["pen"] = level.pen;
    json["enabled"] = level.enabled;
    add_numbers<plot::Level>(json, level_numbers(), level);
    return json;
}

std::vector<plot::Level> levels_of(const JsonValue& value) {
    std::vector<plot::Level> levels;
    for (const JsonValue& level : value.items()) {
        levels.push_back(level_of(level));
    }
    if (levels.size() > static_cast<std::size_t>(most_levels)) {
        value.fail(fmt::format("there are {} levels, and {} at most", levels.size(), most_levels));
    }
    return levels;
}

void read_name(const JsonValue& from, std::string_view key, std::string& to) {
    if (const auto value = from.find(key)) {
        to = value->text();
        if (to.empty()) {
            value->fail("it has no name");
        }
    }
}

} // namespace

PlotInput plot_of(const JsonValue& value) {
    expect_fields<PlotSettings>(value,
                                plot_numbers(),
                                {"file",
                                 "use",
                                 "gray",
                                 "invert",
                                 "tip",
                                 "side",
                                 "corners",
                                 "hatch_cross",
                                 "order",
                                 "link_inside",
                                 "usual_level",
                                 "levels",
                                 "machine",
                                 "post"});
    PlotInput plot;
    PlotSettings& settings = plot.settings;
    if (const auto file = value.find("file")) {
        plot.file = file->text();
    }
    read_choice(value, "use", picture_uses(), settings.use);
    read_choice(value, "gray", gray_rules(), settings.gray);
    read_flag(value, "invert", settings.invert);
    read_choice(value, "tip", tip_kinds(), settings.tip.kind);
    read_choice(value, "side", cutter_sides(), settings.strokes.side);
    read_choice(value, "corners", corner_kinds(), settings.strokes.corners);
    read_flag(value, "hatch_cross", settings.strokes.hatch_cross);
    read_flag(value, "order", settings.strokes.order);
    read_flag(value, "link_inside", settings.strokes.link_inside);
    if (const auto level = value.find("usual_level")) {
        settings.level = level_of(*level);
    }
    read_numbers<PlotSettings>(value, plot_numbers(), settings);
    if (const auto levels = value.find("levels")) {
        settings.levels = levels_of(*levels);
    }
    read_name(value, "machine", settings.machine);
    read_name(value, "post", settings.post);
    return plot;
}

Json json_of(const PlotInput& plot) {
    const PlotSettings& settings = plot.settings;
    Json json;
    json["file"] = plot.file.generic_string();
    json["use"] = row_of(picture_uses(), settings.use).id;
    json["gray"] = row_of(gray_rules(), settings.gray).id;
    json["invert"] = settings.invert;
    json["tip"] = row_of(tip_kinds(), settings.tip.kind).id;
    json["side"] = row_of(cutter_sides(), settings.strokes.side).id;
    json["corners"] = row_of(corner_kinds(), settings.strokes.corners).id;
    json["hatch_cross"] = settings.strokes.hatch_cross;
    json["order"] = settings.strokes.order;
    json["link_inside"] = settings.strokes.link_inside;
    add_numbers<PlotSettings>(json, plot_numbers(), settings);
    json["usual_level"] = json_of(settings.level);
    json["levels"] = Json::array();
    for (const plot::Level& level : settings.levels) {
        json["levels"].push_back(json_of(level));
    }
    json["machine"] = settings.machine;
    json["post"] = settings.post;
    return json;
}

} // namespace millwright::project
