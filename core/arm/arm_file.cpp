#include "core/arm/arm_file.h"

#include "core/arm/arm_zone.h"
#include "core/base/error.h"
#include "core/base/file_format.h"
#include "core/base/json.h"
#include "core/base/units.h"
#include "core/kinematics/machine_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

namespace millwright::arm {

namespace {

constexpr double fastest_joint = 1e6;
constexpr double most_counts = 1e9;

double length(const JsonValue& value) {
    return value.number(-kinematics::farthest_mm, kinematics::farthest_mm);
}

double angle(const JsonValue& value) {
    return from_degrees(value.number(-kinematics::most_degrees, kinematics::most_degrees));
}

JointKind joint_kind(const JsonValue& value) {
    const std::string text = value.text();
    if (text != "revolute" && text != "prismatic") {
        value.fail(fmt::format("'{}' is not \"revolute\" or \"prismatic\"", text));
    }
    return text == "revolute" ? JointKind::revolute : JointKind::prismatic;
}

ArmJoint joint(const JsonValue& value) {
    value.expect_only(
        {"name", "kind", "alpha", "a", "d", "theta", "limits", "max_velocity", "max_acceleration"});
    ArmJoint result;
    result.name = value.at("name").text();
    result.kind = joint_kind(value.at("kind"));
    result.alpha = angle(value.at("alpha"));
    result.a = length(value.at("a"));
    result.d = length(value.at("d"));
    result.theta = angle(value.at("theta"));
    const bool turns = result.kind == JointKind::revolute;
    const auto range = value.at("limits").items(2);
    result.min = turns ? angle(range[0]) : length(range[0]);
    result.max = turns ? angle(range[1]) : length(range[1]);
    if (!(result.min < result.max)) {
        value.at("limits").fail("the lower limit must be below the upper limit");
    }
    constexpr double slowest = 1e-6;
    const double unit = turns ? from_degrees(1.0) : 1.0;
    result.max_velocity = unit * value.at("max_velocity").number(slowest, fastest_joint);
    result.max_acceleration = unit * value.at("max_acceleration").number(slowest, fastest_joint);
    return result;
}

DriveScale drive(const JsonValue& value, bool turns) {
    value.expect_only({"scale", "offset"});
    const double unit = turns ? from_degrees(1.0) : 1.0;
    return {unit * value.at("scale").number(-fastest_joint, fastest_joint),
            unit * value.at("offset").number(-fastest_joint, fastest_joint)};
}

Linkage linkage(const JsonValue& value) {
    value.expect_only({"beta", "gamma", "phi", "omega"});
    return {.beta = length(value.at("beta")),
            .gamma = length(value.at("gamma")),
            .phi = length(value.at("phi")),
            .omega = angle(value.at("omega"))};
}

DriveLimits drive_limits(const JsonValue& value) {
    value.expect_only({"third_minus_second", "roll_plus_fourth_above", "roll_below", "roll_turn", "watched"});
    const auto lead = value.at("third_minus_second").items(2);
    const double least = lead[0].number(-most_counts, most_counts);
    const double most = lead[1].number(-most_counts, most_counts);
    if (!(least < most)) {
        value.at("third_minus_second").fail("the lower limit must be below the upper limit");
    }
    return {.below_second = least,
            .above_second = most,
            .roll_low = value.at("roll_plus_fourth_above").number(-most_counts, most_counts),
            .roll_high = value.at("roll_below").number(-most_counts, most_counts),
            .roll_turn = value.at("roll_turn").number(1.0, most_counts)};
}

ArmActuators actuators(const JsonValue& value) {
    value.expect_only({"drives", "second_linkage", "third_linkage", "limits"});
    const auto drives = value.at("drives").items(5);
    ArmActuators result;
    for (std::size_t n = 0; n < drives.size(); ++n) {
        const bool linear = n == 1 || n == 2;
        result.scales[n] = drive(drives[n], !linear);
    }
    result.second = linkage(value.at("second_linkage"));
    result.third = linkage(value.at("third_linkage"));
    if (const auto limits = value.find("limits")) {
        result.limits = drive_limits(*limits);
    }
    try {
        expect_sound(result);
    } catch (const Error& error) {
        value.fail(error.diagnostic().message);
    }
    return result;
}

/// "base", "joint NAME", "drive 2 cylinder", "drive 3 lever" ...
ArmPart part(const JsonValue& value, const ArmModel& arm, bool has_drives) {
    value.expect_only({"node", "carried_by"});
    const JsonValue carrier = value.at("carried_by");
    const std::string by = carrier.text();
    const std::string node = value.at("node").text();
    if (by == "base") {
        return {node, ArmCarrier::base, 0};
    }
    for (int n = 0; n < arm.joint_count(); ++n) {
        if (by == "joint " + arm.joint(n).name) {
            return {node, ArmCarrier::joint, n};
        }
    }
    for (const ArmPart& known : {ArmPart{"drive 2 cylinder", ArmCarrier::cylinder, 2},
                                 ArmPart{"drive 2 rod", ArmCarrier::rod, 2},
                                 ArmPart{"drive 3 cylinder", ArmCarrier::cylinder, 3},
                                 ArmPart{"drive 3 rod", ArmCarrier::rod, 3},
                                 ArmPart{"drive 3 lever", ArmCarrier::lever, 3},
                                 ArmPart{"drive 3 coupler", ArmCarrier::coupler, 3}}) {
        if (by == known.node) {
            if (!has_drives) {
                carrier.fail("the file describes no drives");
            }
            return {node, known.carrier, known.number};
        }
    }
    carrier.fail(fmt::format("'{}' is not a part that can carry a body", by),
                 "use base, joint NAME, drive 2 or 3 cylinder or rod, drive 3 lever or coupler");
}

ArmBodies
bodies(const JsonValue& value, const ArmModel& arm, bool has_drives, const std::filesystem::path& folder) {
    value.expect_only({"file", "parts"});
    ArmBodies result;
    result.file = folder / value.at("file").text();
    for (const JsonValue& item : value.at("parts").items()) {
        result.parts.push_back(part(item, arm, has_drives));
    }
    return result;
}

/// Whether the rows have length and twist behind their joint.
bool is_classical(const JsonValue& root) {
    const auto convention = root.find("convention");
    const std::string text = convention ? convention->text() : "modified";
    if (text != "modified" && text != "classical") {
        convention->fail(fmt::format("'{}' is not \"modified\" or \"classical\"", text),
                         "use modified (Craig), where alpha and a belong to the link before a joint, or "
                         "classical (distal), where they belong to the link after it");
    }
    return text == "classical";
}

JointPositions home(const JsonValue& value, const std::vector<ArmJoint>& joints) {
    JointPositions result(static_cast<Eigen::Index>(joints.size()));
    const auto positions = value.items(joints.size());
    for (std::size_t n = 0; n < joints.size(); ++n) {
        const bool turns = joints[n].kind == JointKind::revolute;
        const double at = turns ? angle(positions[n]) : length(positions[n]);
        if (at < joints[n].min || at > joints[n].max) {
            positions[n].fail(fmt::format("outside the limits of joint {}", joints[n].name));
        }
        result[static_cast<Eigen::Index>(n)] = at;
    }
    return result;
}

ArmModel arm(const JsonValue& root) {
    ArmDescription description;
    description.name = root.at("name").text();
    description.source = root.at("source").text();
    for (const JsonValue& item : root.at("joints").items()) {
        const ArmJoint next = joint(item);
        const auto same = std::ranges::find(description.joints, next.name, &ArmJoint::name);
        if (same != description.joints.end()) {
            item.at("name").fail("another joint has the same name");
        }
        description.joints.push_back(next);
    }
    const auto tip = root.at("tool_tip").items(3);
    description.tool_tip = {length(tip[0]), length(tip[1]), length(tip[2])};
    const std::size_t count = description.joints.size();
    if (const auto place = root.find("home"); place && count > 0 && count <= most_arm_joints) {
        description.home = home(*place, description.joints);
    }
    if (is_classical(root)) {
        description = from_classical(std::move(description));
    }
    try {
        return ArmModel(std::move(description));
    } catch (const Error& error) {
        root.fail(error.diagnostic().message);
    }
}

/// Where the file says neither that its drives are watched nor where the tip may be, there is none.
std::shared_ptr<const ArmZone> zone(const JsonValue& root, const std::optional<ArmActuators>& drives) {
    ArmZone result;
    const auto space = root.find("workspace");
    if (space) {
        space->expect_only({"x", "y", "z"});
        for (int n = 0; n < 3; ++n) {
            if (const auto range = space->find(std::string(1, "xyz"[n]))) {
                const auto ends = range->items(2);
                result.least[n] = length(ends[0]);
                result.most[n] = length(ends[1]);
                if (!(result.least[n] < result.most[n])) {
                    range->fail("the lower limit must be below the upper limit");
                }
            }
        }
    }
    const auto limits = drives ? root.at("actuators").find("limits") : std::nullopt;
    const auto watched = limits ? limits->find("watched") : std::nullopt;
    if (limits && (!watched || watched->flag())) {
        result.drives = drives;
    }
    return space || result.drives ? std::make_shared<const ArmZone>(std::move(result)) : nullptr;
}

ArmModel with_zone(const ArmModel& arm, std::shared_ptr<const ArmZone> zone) {
    ArmDescription description = arm.description();
    description.zone = std::move(zone);
    return ArmModel(std::move(description));
}

} // namespace

ArmFile read_arm(const std::filesystem::path& file) {
    const JsonValue root = JsonValue::read(file);
    expect_format(root, "millwright-arm", "an arm file");
    root.expect_only({"format",
                      "version",
                      "name",
                      "source",
                      "convention",
                      "joints",
                      "tool_tip",
                      "home",
                      "workspace",
                      "actuators",
                      "bodies"});
    (void)root.at("version").integer(1, 1);
    ArmFile result{arm(root), std::nullopt, std::nullopt};
    if (const auto drives = root.find("actuators")) {
        if (!result.arm.planar_elbow()) {
            drives->fail("only an arm with three parallel joints between base and roll can have such drives");
        }
        result.actuators = actuators(*drives);
    }
    result.arm = with_zone(result.arm, zone(root, result.actuators));
    if (const auto shown = root.find("bodies")) {
        result.bodies = bodies(*shown, result.arm, result.actuators.has_value(), file.parent_path());
    }
    return result;
}

} // namespace millwright::arm
