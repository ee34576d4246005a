// A machine tool as a chain of axes. Frame m is right-handed and fixed to the base; every direction and point
// is given in m with all axes at their physical zero (position + zero_offset = 0). An axis on the head side
// moves the tool by its direction; an axis on the table side moves the workpiece by its direction. Rotary
// axes turn counter-clockwise seen against their direction. Lengths mm, angles rad.
#pragma once

#include "core/geometry/vectors.h"

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::kinematics {

/// One value an axis, in the order of MachineModel::axes(): mm or rad. Nine axes at most, never on the heap.
using AxisPositions = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 9, 1>;

enum class AxisKind { linear, rotary };
enum class AxisSide { table, head };

struct MachineAxis {
    char letter = 'X'; ///< one of XYZABCUVW, as in the program
    AxisKind kind = AxisKind::linear;
    AxisSide side = AxisSide::head;
    Vec3 direction = Vec3::UnitX(); ///< unit
    Vec3 point = Vec3::Zero();      ///< on the line of a rotary axis
    double zero_offset = 0.0;       ///< physical position = programmed position + zero_offset
    double min = -std::numeric_limits<double>::infinity(); ///< programmed; -infinity: no limit
    double max = std::numeric_limits<double>::infinity();
    double max_velocity = 0.0;                                 ///< mm/s or rad/s
    double max_acceleration = 0.0;                             ///< mm/s^2 or rad/s^2
    double max_jerk = std::numeric_limits<double>::infinity(); ///< mm/s^3 or rad/s^3; infinity: no limit
};

/// A simple solid that shows a part of the machine, carried by one axis ('\0': fixed to the base).
struct MachineBody {
    enum class Shape { box, cylinder };
    Shape shape = Shape::box;
    char carried_by = '\0';
    Vec3 center = Vec3::Zero();
    Vec3 size = Vec3::Ones();       ///< box: edges; cylinder: diameter, diameter, height
    Vec3 direction = Vec3::UnitZ(); ///< of a cylinder's height
};

/// Formulas of rotary angles other than the consistent ones that a machine offers for comparison.
enum class AngleFormulas { none, rotary_tilt };

/// What a machine file says. Axes from the base outwards on both sides.
struct MachineDescription {
    std::string name;
    std::string source;                   ///< where the numbers come from
    std::vector<MachineAxis> table;       ///< base to workpiece
    std::vector<MachineAxis> head;        ///< base to tool
    Vec3 table_origin = Vec3::Zero();     ///< where the workpiece offset is counted from
    Vec3 workpiece_offset = Vec3::Zero(); ///< of the workpiece's origin on the table: the set-up (a, b, c)
    Vec3 tool_tip = Vec3::Zero();         ///< of the tool in the spindle
    Vec3 tool_axis = Vec3::UnitZ();       ///< unit, from the tip towards the spindle
    /// OF of the thesis's machine: from the tool tip to the machine's base, mm. Nullopt if unknown.
    std::optional<double> tip_to_base;
    /// Gauge length of the tool in the spindle: from the spindle's gauge line to the tip, mm. Nullopt if
    /// unknown.
    std::optional<double> tool_length;
    /// By how much that tool is longer than the machine file's, for which the machine's zeros hold, mm.
    double tool_length_offset = 0.0;
    AngleFormulas angle_formulas = AngleFormulas::none;
    std::vector<MachineBody> bodies;
};

class MachineModel {
public:
    /// Throws Error unless there are exactly three linear axes that span space, at most three rotary ones
    /// (two must not be parallel; tool paths need two or none), distinct letters, unit directions, finite
    /// numbers, positive rates and min < max.
    explicit MachineModel(MachineDescription description);

    [[nodiscard]] const std::string& name() const { return description_.name; }
    [[nodiscard]] const MachineDescription& description() const { return description_; }

    /// In the order X Y Z A B C U V W.
    [[nodiscard]] const std::vector<MachineAxis>& axes() const { return axes_; }
    [[nodiscard]] int axis_count() const { return static_cast<int>(axes_.size()); }
    /// The index of an axis; -1 if the machine has none of that letter.
    [[nodiscard]] int axis_index(char letter) const;
    [[nodiscard]] const MachineAxis& axis(int index) const { return axes_[static_cast<std::size_t>(index)]; }

    /// Axis indices from the base outwards.
    [[nodiscard]] const std::vector<int>& table_chain() const { return table_chain_; }
    [[nodiscard]] const std::vector<int>& head_chain() const { return head_chain_; }
    /// The rotary axes in the order in which they act on the tool's axis: from the tool to the workpiece.
    [[nodiscard]] const std::vector<int>& rotary_axes() const { return rotary_axes_; }
    [[nodiscard]] const std::array<int, 3>& linear_axes() const { return linear_axes_; }

    /// The workpiece's origin in m with all axes at their physical zero.
    [[nodiscard]] Vec3 workpiece_origin() const {
        return description_.table_origin + description_.workpiece_offset;
    }
    [[nodiscard]] MachineModel with_workpiece_offset(const Vec3& offset) const;

    /// Whether a rotary axis of the head swings the tool: where the tip is then depends on the tool's length.
    [[nodiscard]] bool swings_tool() const;
    /// The same machine with a tool of `gauge_length` (mm, > 0) in the spindle. Without a known length of the
    /// machine file's own tool it stays as it is, since the zeros then hold for any tool; throws Error if the
    /// head swings.
    [[nodiscard]] MachineModel with_tool_length(double gauge_length) const;
    /// Whether a positive length offset along axis Z, as controls add it for G43, makes up for a longer tool.
    [[nodiscard]] bool compensates_along_z() const;

private:
    MachineDescription description_;
    std::vector<MachineAxis> axes_;
    std::vector<int> table_chain_, head_chain_, rotary_axes_;
    std::array<int, 3> linear_axes_{};
};

} // namespace millwright::kinematics
