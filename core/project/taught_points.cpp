#include "core/project/taught_points.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "core/project/internal/arm_json.h"
#include "core/project/internal/setting_json.h"
#include "core/project/json_text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace millwright::project {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view points_format_name = "millwright-arm-points";
constexpr int points_format_version = 1;
constexpr std::size_t most_joints = 9;
constexpr double most_speed = 100.0, least_speed = 0.1, farthest = 1e5;

Vec3 vector_of(const JsonValue& value) {
    const auto items = value.items(3);
    return {items[0].number(-farthest, farthest),
            items[1].number(-farthest, farthest),
            items[2].number(-farthest, farthest)};
}

TaughtPoint taught_point_of(const JsonValue& value) {
    value.expect_only({"name", "joints_deg", "straight", "speed_percent"});
    TaughtPoint point;
    point.name = value.at("name").text();
    for (const JsonValue& joint : value.at("joints_deg").items()) {
        point.joints_deg.push_back(joint.number(-farthest, farthest));
    }
    point.straight = value.at("straight").flag();
    point.speed_percent = value.at("speed_percent").number(least_speed, most_speed);
    return point;
}

} // namespace

std::vector<TaughtPoint> points_of(const JsonValue& array) {
    std::vector<TaughtPoint> points;
    std::set<std::string> names;
    for (const JsonValue& item : array.items()) {
        points.push_back(taught_point_of(item));
        if (const auto faults = faults_of(std::vector{points.back()}); !faults.empty()) {
            item.fail(faults.front());
        }
        if (!names.insert(points.back().name).second) {
            item.at("name").fail("another point has the same name");
        }
    }
    return points;
}

ArmInput arm_of(const JsonValue& value) {
    value.expect_only({"points", "program", "motion_file", "path"});
    ArmInput arm;
    if (const auto points = value.find("points")) {
        arm.points = points_of(*points);
    }
    if (const auto program = value.find("program")) {
        arm.program = program->text();
    }
    if (const auto motion = value.find("motion_file")) {
        arm.motion_file = motion->text();
    }
    if (const auto path = value.find("path")) {
        path->expect_only({"at_mm", "turned_deg", "most_lean_deg"});
        arm.path = {vector_of(path->at("at_mm")), vector_of(path->at("turned_deg"))};
        if (const auto lean = path->find("most_lean_deg")) {
            arm.path.most_lean_deg = lean->number();
        }
    }
    return arm;
}

Json json_of(const std::vector<TaughtPoint>& points) {
    Json array = Json::array();
    for (const TaughtPoint& point : points) {
        Json json;
        json["name"] = point.name;
        json["joints_deg"] = point.joints_deg;
        json["straight"] = point.straight;
        json["speed_percent"] = point.speed_percent;
        array.push_back(std::move(json));
    }
    return array;
}

Json json_of(const ArmInput& arm) {
    Json json;
    json["points"] = json_of(arm.points);
    json["program"] = arm.program;
    json["motion_file"] = arm.motion_file;
    json["path"] = {{"at_mm", point_json(arm.path.at_mm)},
                    {"turned_deg", point_json(arm.path.turned_deg)},
                    {"most_lean_deg", arm.path.most_lean_deg}};
    return json;
}

std::vector<TaughtPoint> taught_points_from_text(std::string_view text, const std::filesystem::path& named) {
    const JsonValue root = JsonValue::parse(text, named);
    root.expect_only({"format", "version", "points"});
    if (root.at("format").text() != points_format_name) {
        root.at("format").fail("not a file of taught points",
                               fmt::format("expected \"{}\"", points_format_name));
    }
    (void)root.at("version").integer(points_format_version, points_format_version);
    return points_of(root.at("points"));
}

std::vector<TaughtPoint> read_taught_points(const std::filesystem::path& file) {
    return taught_points_from_text(read_file(file), file);
}

std::string taught_points_text(const std::vector<TaughtPoint>& points) {
    if (const auto faults = faults_of(points); !faults.empty()) {
        throw Error(faults.front());
    }
    Json json;
    json["format"] = points_format_name;
    json["version"] = points_format_version;
    json["points"] = json_of(points);
    return json_text(json);
}

void write_taught_points(const std::vector<TaughtPoint>& points, const std::filesystem::path& file) {
    write_file(file, taught_points_text(points));
}

std::vector<std::string> faults_of(const std::vector<TaughtPoint>& points) {
    std::vector<std::string> faults;
    std::set<std::string> names;
    for (const TaughtPoint& point : points) {
        if (point.name.empty() || !names.insert(point.name).second) {
            faults.push_back(point.name.empty()
                                 ? std::string("arm/points: a point has no name")
                                 : fmt::format("arm/points: two points are named '{}'", point.name));
        }
        const bool sound = std::ranges::all_of(point.joints_deg, [](double joint) {
            return std::isfinite(joint) && std::abs(joint) <= farthest;
        });
        if (point.joints_deg.empty() || point.joints_deg.size() > most_joints || !sound) {
            faults.push_back(fmt::format("arm/points: '{}' has invalid joint values", point.name));
        }
        if (!(point.speed_percent >= least_speed && point.speed_percent <= most_speed)) {
            faults.push_back(fmt::format("arm/points: the speed of '{}' must be from {} to {} percent",
                                         point.name,
                                         least_speed,
                                         most_speed));
        }
    }
    return faults;
}

std::string free_point_name(const std::vector<TaughtPoint>& points) {
    for (std::size_t n = 1;; ++n) {
        std::string name = fmt::format("Point {}", n);
        if (std::ranges::find(points, name, &TaughtPoint::name) == points.end()) {
            return name;
        }
    }
}

} // namespace millwright::project
