#include "core/kinematics/machine_file.h"

#include "core/base/error.h"
#include "core/base/file_format.h"
#include "core/base/json.h"
#include "core/base/units.h"

#include <fmt/format.h>

#include <string>
#include <utility>

namespace millwright::kinematics {

namespace {

constexpr double fastest_axis = 1e5;
constexpr double hardest = 1e7;
constexpr double sharpest = 1e10;

Vec3 point(const JsonValue& value) {
    const auto items = value.items(3);
    return {items[0].number(-farthest_mm, farthest_mm),
            items[1].number(-farthest_mm, farthest_mm),
            items[2].number(-farthest_mm, farthest_mm)};
}

Vec3 direction(const JsonValue& value) {
    const Vec3 v = point(value);
    if (!(v.norm() > 1e-6)) {
        value.fail("a direction must not be zero");
    }
    return v.normalized();
}

char letter(const JsonValue& value) {
    const std::string text = value.text();
    if (text.size() != 1) {
        value.fail(fmt::format("'{}' must be one letter of XYZABCUVW", text));
    }
    return text.front();
}

AxisKind axis_kind(const JsonValue& value) {
    const std::string text = value.text();
    if (text != "linear" && text != "rotary") {
        value.fail(fmt::format("'{}' is neither \"linear\" nor \"rotary\"", text));
    }
    return text == "linear" ? AxisKind::linear : AxisKind::rotary;
}

MachineAxis axis(const JsonValue& value) {
    value.expect_only({"axis",
                       "kind",
                       "direction",
                       "point",
                       "zero_offset",
                       "limits",
                       "max_velocity",
                       "max_acceleration",
                       "max_jerk"});
    MachineAxis result;
    result.letter = letter(value.at("axis"));
    result.kind = axis_kind(value.at("kind"));
    result.direction = direction(value.at("direction"));
    const bool rotary = result.kind == AxisKind::rotary;
    const double unit = rotary ? from_degrees(1.0) : 1.0;
    const double farthest = rotary ? most_degrees : farthest_mm;
    if (rotary) {
        result.point = point(value.at("point"));
    }
    if (const auto offset = value.find("zero_offset")) {
        result.zero_offset = unit * offset->number(-farthest, farthest);
    }
    if (const auto limits = value.find("limits")) {
        const auto range = limits->items(2);
        result.min = unit * range[0].number(-farthest, farthest);
        result.max = unit * range[1].number(-farthest, farthest);
        if (!(result.min < result.max)) {
            limits->fail("the lower limit must be below the upper limit");
        }
    }
    constexpr double slowest = 1e-6;
    result.max_velocity = unit * value.at("max_velocity").number(slowest, fastest_axis);
    result.max_acceleration = unit * value.at("max_acceleration").number(slowest, hardest);
    if (const auto jerk = value.find("max_jerk")) {
        result.max_jerk = unit * jerk->number(slowest, sharpest);
    }
    return result;
}

MachineBody body(const JsonValue& value) {
    value.expect_only({"shape", "carried_by", "center", "size", "direction"});
    MachineBody result;
    const std::string shape = value.at("shape").text();
    if (shape != "box" && shape != "cylinder") {
        value.at("shape").fail(fmt::format("'{}' is neither \"box\" nor \"cylinder\"", shape));
    }
    result.shape = shape == "box" ? MachineBody::Shape::box : MachineBody::Shape::cylinder;
    if (const auto carrier = value.find("carried_by")) {
        result.carried_by = letter(*carrier);
    }
    result.center = point(value.at("center"));
    result.size = point(value.at("size"));
    if (const auto along = value.find("direction")) {
        result.direction = direction(*along);
    }
    return result;
}

template <class Read> auto list(const JsonValue& value, Read read) {
    std::vector<decltype(read(value))> result;
    for (const JsonValue& item : value.items()) {
        result.push_back(read(item));
    }
    return result;
}

AngleFormulas angle_formulas(const JsonValue& value) {
    if (value.text() != "rotary-tilt") {
        value.fail(fmt::format("unknown angle formulas '{}'", value.text()), "known: rotary-tilt");
    }
    return AngleFormulas::rotary_tilt;
}

} // namespace

MachineModel read_machine(const std::filesystem::path& file) {
    const JsonValue root = JsonValue::read(file);
    expect_format(root, "millwright-machine", "a machine file");
    root.expect_only({"format",
                      "version",
                      "name",
                      "source",
                      "table",
                      "head",
                      "table_origin",
                      "workpiece_offset",
                      "tool_tip",
                      "tool_axis",
                      "tip_to_base",
                      "tool_length",
                      "angle_formulas",
                      "bodies",
                      "solids"});
    (void)root.at("version").integer(1, 1);
    MachineDescription machine;
    machine.name = root.at("name").text();
    machine.source = root.at("source").text();
    machine.table = list(root.at("table"), axis);
    machine.head = list(root.at("head"), axis);
    machine.table_origin = point(root.at("table_origin"));
    machine.workpiece_offset = point(root.at("workpiece_offset"));
    machine.tool_tip = point(root.at("tool_tip"));
    machine.tool_axis = direction(root.at("tool_axis"));
    if (const auto length = root.find("tip_to_base")) {
        machine.tip_to_base = length->number(-farthest_mm, farthest_mm);
    }
    if (const auto length = root.find("tool_length")) {
        machine.tool_length = length->number(0.0, farthest_mm);
    }
    if (const auto formulas = root.find("angle_formulas")) {
        machine.angle_formulas = angle_formulas(*formulas);
    }
    if (const auto bodies = root.find("bodies")) {
        machine.bodies = list(*bodies, body);
    }
    try {
        MachineModel model(std::move(machine));
        if (model.swings_tool() && !model.description().tool_length) {
            root.fail("a head that tilts the tool needs \"tool_length\": the gauge length of the tool whose "
                      "tip is at \"tool_tip\"");
        }
        return model;
    } catch (const Error& error) {
        root.fail(error.diagnostic().message);
    }
}

} // namespace millwright::kinematics
