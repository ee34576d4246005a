#include "core/project/internal/plot_json.h"

#include "core/project/internal/setting_json.h"
#include "core/project/level_settings.h"
#include "core/project/plot_choices.h"
#include "core/project/plot_settings.h"

namespace millwright::project {

namespace {

plot::Level level_of(const JsonValue& value) {
    expect_fields<plot::Level>(value, level_numbers(), {"pen", "enabled", "side"});
    plot::Level level = PlotSettings{}.level;
    level.pen = value.at("pen").integer();
    read_flag(value, "enabled", level.enabled);
    read_numbers<plot::Level>(value, level_numbers(), level);
    if (value.find("side")) {
        level.side = plot::CutterSide::on_line;
        read_choice(value, "side", cutter_sides(), *level.side);
    }
    return level;
}

Json level_json(const plot::Level& level) {
    Json json;
    json["pen"] = level.pen;
    json["enabled"] = level.enabled;
    add_numbers<plot::Level>(json, level_numbers(), level);
    if (level.side) {
        json["side"] = row_of(cutter_sides(), *level.side).id;
    }
    return json;
}

std::vector<plot::Level> levels_of(const JsonValue& value) {
    std::vector<plot::Level> levels;
    for (const JsonValue& level : value.items()) {
        levels.push_back(level_of(level));
    }
    if (levels.size() > static_cast<std::size_t>(most_levels)) {
        value.fail(fmt::format("{} levels, but at most {} are allowed", levels.size(), most_levels));
    }
    return levels;
}

void read_hpgl(const JsonValue& from, hpgl::HpglSettings& to) {
    read_choice(from, "fill", fill_modes(), to.fill);
    read_choice(from, "line_ends", line_ends(), to.line_ends);
    read_flag(from, "dashes", to.dashes);
    bool strict = to.strictness == hpgl::Strictness::strict;
    read_flag(from, "strict", strict);
    to.strictness = strict ? hpgl::Strictness::strict : hpgl::Strictness::tolerant;
}

void add_hpgl(Json& json, const hpgl::HpglSettings& hpgl) {
    json["fill"] = row_of(fill_modes(), hpgl.fill).id;
    json["line_ends"] = row_of(line_ends(), hpgl.line_ends).id;
    json["dashes"] = hpgl.dashes;
    json["strict"] = hpgl.strictness == hpgl::Strictness::strict;
}

void read_name(const JsonValue& from, std::string_view key, std::string& to) {
    if (const auto value = from.find(key)) {
        to = value->text();
        if (to.empty()) {
            value->fail("the name is empty");
        }
    }
}

} // namespace

PlotInput plot_of(const JsonValue& value) {
    expect_fields<PlotSettings>(
        value, plot_numbers(), {"file",        "fill",        "line_ends",   "dashes",      "strict",
                                "use",         "drawing_use", "clear_floor", "gray",        "invert",
                                "turns",       "join_dots",   "tip",         "side",        "corners",
                                "hatch_cross", "order",       "link_inside", "usual_level", "levels",
                                "through",     "machine",     "post"});
    PlotInput plot;
    PlotSettings& settings = plot.settings;
    if (const auto file = value.find("file")) {
        plot.file = file->text();
    }
    read_hpgl(value, settings.hpgl);
    read_choice(value, "use", picture_uses(), settings.use);
    read_choice(value, "drawing_use", drawing_uses(), settings.drawing_use);
    read_flag(value, "clear_floor", settings.clear_floor);
    read_choice(value, "gray", gray_rules(), settings.picture.gray);
    read_flag(value, "invert", settings.picture.invert);
    read_choice(value, "turns", turn_policies(), settings.tracing.turns);
    read_flag(value, "join_dots", settings.join_dots);
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
    read_flag(value, "through", settings.through);
    read_name(value, "machine", settings.machine);
    read_name(value, "post", settings.post);
    return plot;
}

Json json_of(const PlotInput& plot) {
    const PlotSettings& settings = plot.settings;
    Json json;
    json["file"] = plot.file.generic_string();
    add_hpgl(json, settings.hpgl);
    json["use"] = row_of(picture_uses(), settings.use).id;
    json["drawing_use"] = row_of(drawing_uses(), settings.drawing_use).id;
    json["clear_floor"] = settings.clear_floor;
    json["gray"] = row_of(gray_rules(), settings.picture.gray).id;
    json["invert"] = settings.picture.invert;
    json["turns"] = row_of(turn_policies(), settings.tracing.turns).id;
    json["join_dots"] = settings.join_dots;
    json["tip"] = row_of(tip_kinds(), settings.tip.kind).id;
    json["side"] = row_of(cutter_sides(), settings.strokes.side).id;
    json["corners"] = row_of(corner_kinds(), settings.strokes.corners).id;
    json["hatch_cross"] = settings.strokes.hatch_cross;
    json["order"] = settings.strokes.order;
    json["link_inside"] = settings.strokes.link_inside;
    add_numbers<PlotSettings>(json, plot_numbers(), settings);
    if (!settings.spindle_rpm) {
        json.erase("spindle_rpm");
    }
    json["usual_level"] = level_json(settings.level);
    json["levels"] = Json::array();
    for (const plot::Level& level : settings.levels) {
        json["levels"].push_back(level_json(level));
    }
    json["through"] = settings.through;
    json["machine"] = settings.machine;
    json["post"] = settings.post;
    return json;
}

} // namespace millwright::project
