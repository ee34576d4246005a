#include "core/kinematics/machine_model.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace millwright::kinematics {

namespace {

constexpr std::string_view machine_axis_letters = "XYZABCUVW";
constexpr double unit_tolerance = 1e-9; // machine files are written by hand with nine digits or more

[[noreturn]] void refuse(const MachineDescription& machine, const std::string& why) {
    throw Error(fmt::format("machine '{}': {}", machine.name, why));
}

bool is_unit(const Vec3& direction) {
    return is_finite(direction) && std::abs(direction.norm() - 1.0) < unit_tolerance;
}

void check(const MachineDescription& machine, const MachineAxis& axis) {
    const std::string where = fmt::format("axis {}", axis.letter);
    if (machine_axis_letters.find(axis.letter) == std::string_view::npos) {
        refuse(machine, where + " is not one of X Y Z A B C U V W");
    }
    if (!is_unit(axis.direction)) {
        refuse(machine, where + ": the direction is not a unit vector");
    }
    if (!is_finite(axis.point) || !std::isfinite(axis.zero_offset)) {
        refuse(machine, where + ": a number is not finite");
    }
    if (!(axis.min < axis.max)) {
        refuse(machine, where + ": the lower limit must be below the upper limit");
    }
    if (!(axis.max_velocity > 0.0 && std::isfinite(axis.max_velocity)) ||
        !(axis.max_acceleration > 0.0 && std::isfinite(axis.max_acceleration))) {
        refuse(machine, where + ": velocity and acceleration limits must be positive");
    }
    if (!(axis.max_jerk > 0.0)) {
        refuse(machine, where + ": the jerk limit must be positive");
    }
}

void check(const MachineDescription& machine, const MachineBody& body) {
    const bool sized = is_finite(body.size) && body.size.minCoeff() > 0.0;
    if (!sized || !is_finite(body.center) || !is_unit(body.direction)) {
        refuse(machine, "a body has a size that is not positive, or a direction that is not a unit vector");
    }
}

void check_tool_and_origins(const MachineDescription& machine) {
    if (!is_unit(machine.tool_axis)) {
        refuse(machine, "the tool axis is not a unit vector");
    }
    if (machine.tool_length && !(*machine.tool_length >= 0.0)) {
        refuse(machine, "the tool length is negative");
    }
    if (!is_finite(machine.table_origin) || !is_finite(machine.workpiece_offset) ||
        !is_finite(machine.tool_tip)) {
        refuse(machine, "a number is not finite");
    }
}

int place(char letter) {
    return static_cast<int>(machine_axis_letters.find(letter));
}

} // namespace

MachineModel::MachineModel(MachineDescription description) : description_(std::move(description)) {
    for (MachineAxis& axis : description_.table) {
        axis.side = AxisSide::table;
    }
    for (MachineAxis& axis : description_.head) {
        axis.side = AxisSide::head;
    }
    axes_ = description_.table;
    axes_.insert(axes_.end(), description_.head.begin(), description_.head.end());
    for (const MachineAxis& axis : axes_) {
        check(description_, axis);
    }
    std::sort(axes_.begin(), axes_.end(), [](const MachineAxis& a, const MachineAxis& b) {
        return place(a.letter) < place(b.letter);
    });
    for (std::size_t n = 1; n < axes_.size(); ++n) {
        if (axes_[n].letter == axes_[n - 1].letter) {
            refuse(description_, fmt::format("axis {} occurs twice", axes_[n].letter));
        }
    }
    const auto index_of = [this](const MachineAxis& axis) { return axis_index(axis.letter); };
    std::transform(
        description_.table.begin(), description_.table.end(), std::back_inserter(table_chain_), index_of);
    std::transform(
        description_.head.begin(), description_.head.end(), std::back_inserter(head_chain_), index_of);

    std::vector<int> from_tool(head_chain_.rbegin(), head_chain_.rend());
    from_tool.insert(from_tool.end(), table_chain_.begin(), table_chain_.end());
    std::vector<int> linear;
    for (const int n : from_tool) {
        (axis(n).kind == AxisKind::rotary ? rotary_axes_ : linear).push_back(n);
    }
    constexpr std::size_t most_rotary = 3;
    if (linear.size() != 3 || rotary_axes_.size() > most_rotary) {
        refuse(description_, "three linear axes and at most three rotary axes are required");
    }
    std::sort(linear.begin(), linear.end());
    std::copy(linear.begin(), linear.end(), linear_axes_.begin());

    Mat3 span;
    span << axis(linear[0]).direction, axis(linear[1]).direction, axis(linear[2]).direction;
    constexpr double flat = 1e-3;
    if (std::abs(span.determinant()) < flat) {
        refuse(description_, "the linear axes do not span space");
    }
    if (rotary_axes_.size() == 2 &&
        axis(rotary_axes_[0]).direction.cross(axis(rotary_axes_[1]).direction).norm() < flat) {
        refuse(description_, "the rotary axes are parallel");
    }
    check_tool_and_origins(description_);
    for (const MachineBody& body : description_.bodies) {
        check(description_, body);
        if (body.carried_by != '\0' && axis_index(body.carried_by) < 0) {
            refuse(description_,
                   fmt::format("a body is carried by axis {}, which does not exist", body.carried_by));
        }
    }
}

int MachineModel::axis_index(char letter) const {
    const auto found = std::find_if(
        axes_.begin(), axes_.end(), [letter](const MachineAxis& axis) { return axis.letter == letter; });
    return found == axes_.end() ? -1 : static_cast<int>(found - axes_.begin());
}

MachineModel MachineModel::with_workpiece_offset(const Vec3& offset) const {
    MachineDescription changed = description_;
    changed.workpiece_offset = offset;
    return MachineModel(std::move(changed));
}

bool MachineModel::swings_tool() const {
    return std::any_of(
        head_chain_.begin(), head_chain_.end(), [this](int n) { return axis(n).kind == AxisKind::rotary; });
}

MachineModel MachineModel::with_tool_length(double gauge_length) const {
    expects(gauge_length > 0.0 && std::isfinite(gauge_length), "a tool has a length");
    if (!description_.tool_length) {
        if (swings_tool()) {
            throw Error(fmt::format("machine '{}' does not specify the length of the tool at its tool tip",
                                    description_.name),
                        {},
                        "add \"tool_length\" to its file");
        }
        return *this;
    }
    MachineDescription changed = description_;
    const double longer = gauge_length - *changed.tool_length;
    changed.tool_tip -= longer * changed.tool_axis;
    changed.tool_length = gauge_length;
    changed.tool_length_offset += longer;
    return MachineModel(std::move(changed));
}

bool MachineModel::compensates_along_z() const {
    const int z = axis_index('Z');
    if (z < 0 || axis(z).kind != AxisKind::linear) {
        return false;
    }
    const double sense = axis(z).side == AxisSide::head ? 1.0 : -1.0;
    return (sense * axis(z).direction - description_.tool_axis).norm() < unit_tolerance;
}

} // namespace millwright::kinematics
