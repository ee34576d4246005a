// From a program to the way of its axes: lengths, limits and corners of every block.
#pragma once

#include "core/motion/internal/mechanism.h"
#include "core/motion/internal/planned_move.h"
#include "core/motion/internal/profile.h"
#include "core/motion/internal/rounding.h"
#include "core/motion/planner.h"
#include "core/program/program.h"

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace millwright::motion::internal {

// The way of a program's axes, laid block by block: lengths, limits and corners. What lies behind can be
// forgotten, so that a program of any length is laid in little memory.

/// Throws Error if the program's axes are not the machine's.
void check_axes(const std::vector<program::ProgramAxis>& axes,
                const std::string& machine_of_program,
                const Mechanism& machine);
/// Throws Defect for a setting out of range, or a start that is invalid for the machine.
void check_settings(const PlannerSettings& settings,
                    const Mechanism& machine,
                    const kinematics::AxisPositions& start);

/// Where a block goes. Throws Defect if that is not finite.
[[nodiscard]] kinematics::AxisPositions position_after(const program::Block& block,
                                                       const kinematics::AxisPositions& before);

/// Whether the axes go on moving.
[[nodiscard]] bool keeps_moving(program::BlockKind kind);

/// How two moves meet.
enum class Meeting { rest, rounding, corner };
[[nodiscard]] Meeting meeting_of(const program::PathControl& last_path,
                                 const kinematics::AxisPositions& last_unit,
                                 bool last_rapid,
                                 const kinematics::AxisPositions& next_unit,
                                 bool next_rapid);
/// mm, of a continuous path.
[[nodiscard]] double rounding_tolerance_of(const program::PathControl& path, const PlannerSettings& settings);

class AxisPathBuilder {
public:
    /// Machine and settings must outlive it. Without `part` the way on the part is not measured, which takes
    /// half of the time.
    AxisPathBuilder(const Mechanism& machine,
                    const PlannerSettings& settings,
                    double filter_time,
                    const kinematics::AxisPositions& start,
                    bool part);

    void reserve(std::size_t blocks);
    /// From the next corner on.
    void set_rounding_bounds(const RoundingBounds& bounds) { bounds_ = bounds; }
    /// The linear axes together accelerate along it by `path_acceleration` mm/s2 at most. Throws what plan()
    /// throws for a block.
    void add(const program::Block& block, double path_acceleration = std::numeric_limits<double>::infinity());
    /// No more blocks come: the last move ends at rest.
    void finish() { stop(); }

    /// As far as it has limits, and is not forgotten; the limits of what is laid last may still become lower,
    /// up to reach() back.
    [[nodiscard]] const Path& with_limits();
    [[nodiscard]] double limited_to() const { return limited_to_; }
    [[nodiscard]] double kept_from() const { return kept_from_; }
    [[nodiscard]] int block_count() const { return path_.block_count(); } ///< that are not forgotten
    /// How far a limit holds beyond both ends of its place, at most.
    [[nodiscard]] double reach() const { return reach_; }
    /// Of what lies before `way` only the limits that reach beyond it are kept.
    void forget_before(double way);
    /// Everything, with its limits.
    [[nodiscard]] Path take(const Progress& progress);

private:
    const Mechanism& machine_;
    const PlannerSettings& settings_;
    bool part_;
    Path path_;
    std::vector<Zone> speeds_, accelerations_;
    double kept_from_ = 0.0; ///< the way before is forgotten
    int forgotten_ = 0;      ///< blocks
    double reach_ = 0.0;     ///< reach()
    RoundingBounds bounds_;
    std::optional<PlannedMove> last_; ///< the last move
    bool open_ = false;               ///< its end has no limits yet
    double limited_to_ = 0.0;         ///< the way that has limits
    double way_ = 0.0;                ///< up to the end of the last block
    Vec3 last_tip_;

    Segment& segment_of(const PlannedMove& move) {
        return path_.segments[static_cast<std::size_t>(move.block - forgotten_)];
    }
    void add_move(const program::Block& block,
                  const kinematics::AxisPositions& before,
                  const kinematics::AxisPositions& after,
                  double path_acceleration);
    void stop();
    void limit_last_up_to_rounding(double d); ///< which begins `d` before its end; 0: there is none
    void limit_up_to(double end, double speed, Cause by, double acceleration, Cause acceleration_by);
    void limit_corner(double speed);
    void add_feed(const PlannedMove& move, double start, double end);
    [[nodiscard]] double programmed_to() const;
    void meet(const PlannedMove& next, const kinematics::AxisPositions& position);
    void round(const Corner& corner, const PlannedMove& next, double tolerance);
    void limit_half(const Corner& corner, double d, double end, double fastest);
    void add_part_length(const kinematics::AxisPositions& position, bool moved);
};

/// As plan() and, where there are `accelerations`, plan_within() describe. Throws what they throw.
[[nodiscard]] Path lay_out(const program::Program& program,
                           const Mechanism& machine,
                           const PlannerSettings& settings,
                           const kinematics::AxisPositions& start,
                           std::span<const double> accelerations,
                           const Progress& progress);

} // namespace millwright::motion::internal
