#include "core/project/internal/elliptic_json.h"

#include "core/project/internal/region_area.h"
#include "core/project/setting_tables.h"

namespace millwright::project {

namespace {

grid::MixSettings mix_of(const JsonValue& value) {
    expect_fields<grid::MixSettings>(value, mix_numbers(), {"combination"});
    grid::MixSettings mix;
    read_numbers<grid::MixSettings>(value, mix_numbers(), mix);
    read_choice(value, "combination", combinations(), mix.combination);
    if (mix.high < mix.low) {
        value.fail("the maximum weight is below the minimum");
    }
    return mix;
}

grid::Field field_of(const JsonValue& value) {
    const std::vector<JsonValue> rows = value.items();
    const int columns = rows.empty() ? 0 : static_cast<int>(rows.front().items().size());
    const auto count = static_cast<int>(rows.size());
    if (count < 2 || count > most_painted || columns < 2 || columns > most_painted) {
        value.fail(fmt::format("painted values need 2 to {} rows and columns", most_painted));
    }
    grid::Field field = grid::Field::constant(count, columns, 0.0);
    for (int i = 0; i < count; ++i) {
        const std::vector<JsonValue> row =
            rows[static_cast<std::size_t>(i)].items(static_cast<std::size_t>(columns));
        for (int j = 0; j < columns; ++j) {
            field.values[field.index(i, j)] = row[static_cast<std::size_t>(j)].number(0.0, 1.0);
        }
    }
    return field;
}

Json field_json(const grid::Field& field) {
    Json rows = Json::array();
    for (int i = 0; i < field.rows; ++i) {
        Json row = Json::array();
        for (int j = 0; j < field.columns; ++j) {
            row.push_back(field.values[field.index(i, j)]);
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

grid::Region region_of(const JsonValue& value) {
    expect_fields<grid::Region>(value, region_numbers(), {"outline"});
    grid::Region region;
    read_numbers<grid::Region>(value, region_numbers(), region);
    const JsonValue outline = value.at("outline");
    for (const JsonValue& corner : outline.items()) {
        const std::vector<JsonValue> uv = corner.items(2);
        region.outline.emplace_back(uv[0].number(0.0, 1.0), uv[1].number(0.0, 1.0));
    }
    const auto count = std::ssize(region.outline);
    if ((count > 0 && count < grid::fewest_corners) || count > grid::most_corners) {
        outline.fail(fmt::format(
            "an outline needs {} to {} corners, each [u, v]", grid::fewest_corners, grid::most_corners));
    }
    if (!region.everywhere() && !encloses_area(region.outline)) {
        outline.fail("the outline encloses no area", "omit the region to adapt everywhere");
    }
    return region;
}

Json region_json(const grid::Region& region) {
    Json json;
    json["outline"] = Json::array();
    for (const Vec2& corner : region.outline) {
        json["outline"].push_back(Json::array({corner.x(), corner.y()}));
    }
    add_numbers<grid::Region>(json, region_numbers(), region);
    return json;
}

Json mix_json(const grid::MixSettings& mix) {
    Json json;
    add_numbers<grid::MixSettings>(json, mix_numbers(), mix);
    json["combination"] = row_of(combinations(), mix.combination).id;
    return json;
}

} // namespace

EllipticInput elliptic_of(const JsonValue& value) {
    expect_fields<EllipticInput>(
        value,
        elliptic_numbers(),
        {"weight", "expression", "sliding_boundary", "any_memory", "mix", "painted", "region", "solver"});
    EllipticInput result;
    read_numbers<EllipticInput>(value, elliptic_numbers(), result);
    read_choice(value, "weight", weight_sources(), result.weight);
    if (!names_harmonic_solver(value)) {
        read_choice(value, "solver", elliptic_solvers(), result.solver);
    }
    if (const auto expression = value.find("expression")) {
        result.expression = expression->text();
    }
    if (const auto mix = value.find("mix")) {
        result.mix = mix_of(*mix);
    }
    if (const auto painted = value.find("painted")) {
        result.painted = field_of(*painted);
    }
    if (const auto region = value.find("region")) {
        result.region = region_of(*region);
    }
    read_flag(value, "sliding_boundary", result.sliding_boundary);
    read_flag(value, "any_memory", result.any_memory);
    return result;
}

bool names_harmonic_solver(const JsonValue& elliptic) {
    const auto solver = elliptic.find("solver");
    return solver && solver->text() == "harmonic";
}

Json json_of(const EllipticInput& input) {
    Json json;
    json["weight"] = row_of(weight_sources(), input.weight).id;
    json["expression"] = input.expression;
    if (input.mix != grid::MixSettings{}) {
        json["mix"] = mix_json(input.mix);
    }
    if (input.painted) {
        json["painted"] = field_json(*input.painted);
    }
    if (!(input.region == grid::Region{})) {
        json["region"] = region_json(input.region);
    }
    if (input.solver != EllipticInput{}.solver) {
        json["solver"] = row_of(elliptic_solvers(), input.solver).id;
    }
    add_numbers<EllipticInput>(json, elliptic_numbers(), input);
    json["sliding_boundary"] = input.sliding_boundary;
    if (input.any_memory) { // said where it was allowed only
        json["any_memory"] = true;
    }
    return json;
}

} // namespace millwright::project
