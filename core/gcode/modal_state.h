// What stays in force from line to line. Lengths are in the program's present unit, angles in degrees, feeds
// and speeds as programmed.
#pragma once

#include "core/gcode/axes.h"
#include "core/gcode/canon.h"

#include <cstdint>

namespace millwright::gcode {

enum class LengthUnit : std::uint8_t { inch = 1, mm = 2 };

inline constexpr double mm_per_inch = 25.4;

enum class FeedMode : std::uint8_t { per_minute, inverse_time, per_revolution };
enum class SpindleTurning : std::uint8_t { stopped, clockwise, counterclockwise };
enum class CutterSide : std::uint8_t { off, right, left };
enum class DistanceMode : std::uint8_t { absolute, incremental };
/// Whether the S word is the spindle's speed (G97), or that of the surface past the tool (G96).
enum class SpindleMode : std::uint8_t { constant_speed, constant_surface_speed };
/// Where a canned cycle ends: at the height before the cycles (G98) or at its R word (G99).
enum class CycleReturn : std::uint8_t { initial_level, r_level };

/// Which of them are enabled, by M48 to M53.
struct OverrideSwitches {
    bool feed = true, speed = true, adaptive_feed = false, feed_hold = true;
};

/// Cutter radius compensation, G40 to G42.1.
struct CutterCompensation {
    CutterSide side = CutterSide::off;
    double radius = 0.0;        ///< >= 0
    int orientation = 0;        ///< of a lathe tool, 0 none
    bool first_move = true;     ///< the next move leads onto the offset path
    bool arc_forbidden = false; ///< the next move leaves it and must be straight

    [[nodiscard]] bool on() const { return side != CutterSide::off; }
};

/// Words that canned cycles remember.
struct CycleMemory {
    double bottom = 0.0;
    double i = 0.0, j = 0.0, k = 0.0;
    double p = 0.0, q = 0.0, r = 0.0;
    double initial_level = 0.0;     ///< where the drilling axis was before the first of the cycles
    bool initial_level_set = false; ///< until a motion that is no cycle
};

struct ModalState {
    AxisValues position;   ///< in the active coordinate system, of the compensated path
    AxisValues programmed; ///< X Y Z as programmed, while cutter compensation is on
    AxisValues g5x_offset, g92_offset, tool_offset;
    int coordinate_system = 1; ///< 1: G54 to 9: G59.3
    double rotation_deg = 0.0; ///< of the coordinate system about Z
    int motion = 800;          ///< in tenths; 800, G80: none
    Plane plane = Plane::xy;
    LengthUnit unit = LengthUnit::mm;
    DistanceMode distance = DistanceMode::absolute;        ///< G90, G91
    DistanceMode arc_distance = DistanceMode::incremental; ///< of I J K: G90.1, G91.1
    bool diameter_mode = false;                            ///< G7
    CycleReturn cycle_return = CycleReturn::r_level;
    FeedMode feed_mode = FeedMode::per_minute;
    double feed_rate = 0.0;
    program::PathMode path_mode = program::PathMode::continuous;
    double path_tolerance = 0.0;
    double naivecam_tolerance = 0.0;
    SpindleTurning spindle = SpindleTurning::stopped;
    double spindle_speed = 0.0;
    SpindleMode spindle_mode = SpindleMode::constant_speed;
    bool mist = false, flood = false;
    OverrideSwitches overrides;
    int selected_tool = 0;  ///< number, by T
    int length_tool = 0;    ///< whose length G43 has put in force; 0: none, or one that has no number
    int selected_row = 0;   ///< in the tool table; 0: none
    int row_in_spindle = 0; ///< where the tool in the spindle came from; 0: none
    Tool spindle_tool;      ///< as it was when it was loaded or set
    CutterCompensation cutter;
    CycleMemory cycle;
};

} // namespace millwright::gcode
