#include "core/project/internal/surface_json.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/exchange/cad_file.h"
#include "core/geometry/presets.h"
#include "core/project/internal/joined_faults.h"
#include "core/project/internal/part_size.h"
#include "core/project/internal/setting_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace millwright::project {

namespace {

/// The elements of a list of equally long lists, row by row.
std::vector<std::vector<JsonValue>> rows_of_table(const JsonValue& value,
                                                  std::size_t most = geometry::max_degree + 1) {
    std::vector<std::vector<JsonValue>> rows;
    for (const JsonValue& row : value.items()) {
        rows.push_back(rows.empty() ? row.items() : row.items(rows.front().size()));
    }
    if (rows.size() < 2 || rows.size() > most || rows.front().size() < 2 || rows.front().size() > most) {
        value.fail(fmt::format("a control net needs 2 to {} rows and columns", most));
    }
    return rows;
}

geometry::Trim trim(const JsonValue& value) {
    constexpr std::size_t fewest_corners = 3;
    geometry::Trim result;
    std::size_t corners = 0;
    for (const JsonValue& loop : value.items()) {
        geometry::Trim::Loop& read = result.loops.emplace_back();
        for (const JsonValue& corner : loop.items()) {
            const auto uv = corner.items(2);
            read.emplace_back(uv[0].number(0.0, 1.0), uv[1].number(0.0, 1.0));
        }
        corners += read.size();
        if (read.size() < fewest_corners) {
            loop.fail("an outline needs at least three corners");
        }
    }
    if (result.loops.size() > geometry::most_trim_loops || corners > geometry::most_trim_corners) {
        value.fail(fmt::format("outlines can have at most {} loops and {} corners",
                               geometry::most_trim_loops,
                               geometry::most_trim_corners));
    }
    return result;
}

/// The `points` and `weights` of `value` into `result`, a net of any kind, of at most so many rows and
/// columns.
template <class Net> void read_net(const JsonValue& value, Net& result, std::size_t most) {
    const auto points = rows_of_table(value.at("points"), most);
    const int rows = static_cast<int>(points.size());
    const int columns = static_cast<int>(points.front().size());
    result.rows = rows;
    result.columns = columns;
    const auto count = static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
    result.points.assign(count, Vec3::Zero());
    result.weights.assign(count, 1.0);
    const auto weights = value.find("weights");
    const auto weight_rows = weights ? rows_of_table(*weights, most) : std::vector<std::vector<JsonValue>>{};
    if (weights &&
        (weight_rows.size() != points.size() || weight_rows.front().size() != points.front().size())) {
        weights->fail(fmt::format("expected {} x {} weights, one per point", rows, columns));
    }
    constexpr double largest_weight = 1e6;
    for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < columns; ++j) {
            const auto row = static_cast<std::size_t>(i);
            const auto column = static_cast<std::size_t>(j);
            result.points[result.index(i, j)] = point_of(points[row][column]);
            if (weights) {
                result.weights[result.index(i, j)] =
                    weight_rows[row][column].number(1.0 / largest_weight, largest_weight);
            }
        }
    }
}

geometry::ControlNet net(const JsonValue& value) {
    value.expect_only({"points", "weights", "trim"});
    geometry::ControlNet result;
    read_net(value, result, geometry::max_degree + 1);
    return result;
}

std::vector<double> knots(const JsonValue& value) {
    std::vector<double> result;
    for (const JsonValue& knot : value.items()) {
        result.push_back(knot.number(0.0, 1.0));
    }
    return result;
}

/// The fields of a face; its owner says which others it has.
FaceInput face(const JsonValue& value) {
    FaceInput result;
    const auto degree = value.at("degree").items(2);
    result.net.degree_u = degree[0].integer(1, geometry::max_bspline_degree);
    result.net.degree_v = degree[1].integer(1, geometry::max_bspline_degree);
    result.net.knots_u = knots(value.at("knots_u"));
    result.net.knots_v = knots(value.at("knots_v"));
    read_net(value, result.net, geometry::most_bspline_points);
    if (const std::string fault = geometry::fault_of(result.net); !fault.empty()) {
        value.fail(fault);
    }
    const double size = size_of(result.net.points);
    if (const std::string fault = fault_of_size(size); !fault.empty()) {
        value.fail("the part " + fault, question_of_unit(size));
    }
    if (const auto outline = value.find("trim")) {
        result.trim = trim(*outline);
    }
    return result;
}

JoinedFace joined_face(const JsonValue& value, int place) {
    value.expect_only({"number", "degree", "knots_u", "knots_v", "points", "weights", "trim"});
    JoinedFace result;
    const auto number = value.find("number");
    result.number = number ? number->integer(1, exchange::most_cad_faces) : place + 1;
    result.face = face(value);
    if (!result.face.trim.everything()) {
        value.at("trim").fail(std::string(no_joined_trim), "remove the outline, or the face");
    }
    return result;
}

JoinedInput joined(const JsonValue& value) {
    value.expect_only({"faces", "corners"});
    JoinedInput result;
    const JsonValue faces = value.at("faces");
    for (const JsonValue& one : faces.items()) {
        result.faces.push_back(joined_face(one, static_cast<int>(result.faces.size())));
    }
    if (std::string fault = fault_of_count(result.faces.size()); !fault.empty()) {
        faces.fail(fault);
    }
    if (const auto corners = value.find("corners")) {
        const auto places = corners->items(4);
        result.corners.emplace();
        std::ranges::transform(places, result.corners->begin(), point_of);
    }
    return result;
}

void read_preset(const JsonValue& value, SurfaceInput& surface) {
    surface.preset = value.text();
    try {
        surface.patches = project_from_preset(surface.preset).surface.patches;
    } catch (const Error& unknown) {
        value.fail(unknown.diagnostic().message, unknown.diagnostic().hint);
    }
}

void expect_size(const JsonValue& machined, const SurfaceInput& surface) {
    const double size = size_of(surface.patches[static_cast<std::size_t>(surface.machined_patch)].points);
    if (const std::string fault = fault_of_size(size); !fault.empty()) {
        machined.fail("the part " + fault, question_of_unit(size));
    }
}

template <class Net, class Of> Json table_of(const Net& net, Of of) {
    Json rows = Json::array();
    for (int i = 0; i < net.rows; ++i) {
        Json row = Json::array();
        for (int j = 0; j < net.columns; ++j) {
            row.push_back(of(i, j));
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

template <class Net> void add_net(Json& json, const Net& net) {
    json["points"] = table_of(net, [&](int i, int j) { return point_json(net.points[net.index(i, j)]); });
    const auto is_one = [](double weight) { return exactly_equal(weight, 1.0); };
    if (!std::all_of(net.weights.begin(), net.weights.end(), is_one)) {
        json["weights"] = table_of(net, [&](int i, int j) { return net.weights[net.index(i, j)]; });
    }
}

Json net_json(const geometry::ControlNet& net) {
    Json json;
    add_net(json, net);
    return json;
}

Json trim_json(const geometry::Trim& trim) {
    Json loops = Json::array();
    for (const geometry::Trim::Loop& loop : trim.loops) {
        Json corners = Json::array();
        for (const Vec2& corner : loop) {
            corners.push_back(Json::array({corner.x(), corner.y()}));
        }
        loops.push_back(std::move(corners));
    }
    return loops;
}

Json face_json(const FaceInput& face) {
    Json json;
    json["degree"] = Json::array({face.net.degree_u, face.net.degree_v});
    json["knots_u"] = face.net.knots_u;
    json["knots_v"] = face.net.knots_v;
    add_net(json, face.net);
    if (!face.trim.everything()) {
        json["trim"] = trim_json(face.trim);
    }
    return json;
}

Json joined_json(const JoinedInput& joined) {
    Json json;
    json["faces"] = Json::array();
    for (const JoinedFace& one : joined.faces) {
        Json face;
        face["number"] = one.number;
        face.update(face_json(one.face));
        json["faces"].push_back(std::move(face));
    }
    if (joined.corners) {
        json["corners"] = Json::array();
        for (const Vec3& corner : *joined.corners) {
            json["corners"].push_back(point_json(corner));
        }
    }
    return json;
}

} // namespace

SurfaceInput surface_input_of(const JsonValue& value) {
    SurfaceInput result;
    if (const auto exact = value.find("face")) {
        value.expect_only({"face", "flipped"});
        exact->expect_only({"degree", "knots_u", "knots_v", "points", "weights", "trim"});
        result.face = face(*exact);
        read_flag(value, "flipped", result.flipped);
        return result;
    }
    if (const auto several = value.find("joined")) {
        value.expect_only({"joined", "flipped"});
        result.joined = joined(*several);
        read_flag(value, "flipped", result.flipped);
        return result;
    }
    value.expect_only({"preset", "patches", "machined_patch", "flipped"});
    if (const auto preset = value.find("preset")) {
        read_preset(*preset, result);
    }
    if (const auto patches = value.find("patches")) {
        result.patches.clear();
        for (const JsonValue& patch : patches->items()) {
            result.patches.push_back(net(patch));
            if (const auto outline = patch.find("trim")) {
                result.trims.resize(result.patches.size() - 1);
                result.trims.push_back(trim(*outline));
            }
        }
    }
    if (result.patches.empty()) {
        value.fail("a surface needs a \"preset\" or at least one patch in \"patches\"");
    }
    if (const auto machined = value.find("machined_patch")) {
        result.machined_patch = machined->integer(0, static_cast<int>(result.patches.size()) - 1);
    }
    if (const auto patches = value.find("patches")) {
        expect_size(patches->items()[static_cast<std::size_t>(result.machined_patch)], result);
    }
    read_flag(value, "flipped", result.flipped);
    return result;
}

Json json_of(const SurfaceInput& surface) {
    Json json;
    if (surface.face) {
        json["face"] = face_json(*surface.face);
        json["flipped"] = surface.flipped;
        return json;
    }
    if (surface.joined) {
        json["joined"] = joined_json(*surface.joined);
        json["flipped"] = surface.flipped;
        return json;
    }
    if (!surface.preset.empty()) {
        json["preset"] = surface.preset;
    }
    json["patches"] = Json::array();
    for (const geometry::ControlNet& net : surface.patches) {
        json["patches"].push_back(net_json(net));
        const std::size_t n = json["patches"].size() - 1;
        if (n < surface.trims.size() && !surface.trims[n].everything()) {
            json["patches"].back()["trim"] = trim_json(surface.trims[n]);
        }
    }
    json["machined_patch"] = surface.machined_patch;
    json["flipped"] = surface.flipped;
    return json;
}

} // namespace millwright::project
