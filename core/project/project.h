// All that the user entered, as one plain value: copying it is the undo step, comparing two tells what is
// stale, saving it is one JSON file. Everything else is derived from it (plan.h, pipeline.h, plot_work.h) and
// can be thrown away. People's units at this border: mm, deg, mm/min; only plots keep the core's.
#pragma once

#include "core/geometry/bspline_surface.h"
#include "core/geometry/surface.h"
#include "core/geometry/trim.h"
#include "core/grid/grid.h"
#include "core/grid/grid_optimiser.h"
#include "core/grid/region.h"
#include "core/grid/weight_mix.h"
#include "core/kinematics/rotary_tilt.h"
#include "core/project/arm_input.h"
#include "core/project/grid_methods/grid_method.h"
#include "core/project/plot_input.h"
#include "core/project/processor_input.h"
#include "core/project/stock_input.h"
#include "core/project/tool_input.h"
#include "core/toolpath/sequenced_path.h"

#include <optional>
#include <string>
#include <vector>

namespace millwright::project {

/// A face of a CAD model as it is, of any number of spans.
struct FaceInput {
    geometry::BsplineNet net;
    geometry::Trim trim; ///< what of it is cut

    friend bool operator==(const FaceInput&, const FaceInput&) = default;
};

/// One of several faces that are machined as one surface.
struct JoinedFace {
    int number = 1; ///< what messages call it: its number in the file that it is from
    FaceInput face;

    friend bool operator==(const JoinedFace&, const JoinedFace&) = default;
};

/// Faces of a CAD model that continue one another (core/region/joined_region.h).
struct JoinedInput {
    std::vector<JoinedFace> faces; ///< 2 to region::most_region_faces
    /// Next to these places on the boundary lie the corners of the square that the faces are spread out on,
    /// mm, (0,0) first; nothing: they are searched for.
    std::optional<std::array<Vec3, 4>> corners;

    friend bool operator==(const JoinedInput&, const JoinedInput&) = default;
};

/// The design: the nets themselves, and the preset they started from for people to see.
struct SurfaceInput {
    std::string preset;                        ///< id of the preset it started from; empty if none
    std::vector<geometry::ControlNet> patches; ///< at least one, or none if there are faces
    std::vector<geometry::Trim> trims;         ///< one per patch; those that are missing: all of the patch
    int machined_patch = 0;                    ///< index of the patch that the tool path covers
    bool flipped = false;                      ///< cut on the side against S_u x S_v

    std::optional<FaceInput> face{};     ///< in place of patches
    std::optional<JoinedInput> joined{}; ///< in place of patches and face

    /// The face, or those that are joined; none of patches.
    [[nodiscard]] std::vector<const FaceInput*> exact_faces() const;
    [[nodiscard]] std::vector<FaceInput*> exact_faces();
    [[nodiscard]] bool has_patches() const { return !face && !joined; }
    /// What of the face, or of the patch that the tool path covers, is cut. Joined faces: all of them.
    [[nodiscard]] geometry::Trim machined_trim() const {
        return joined ? geometry::Trim{} : face ? face->trim : trim(machined_patch);
    }
    /// What of a patch is cut.
    [[nodiscard]] geometry::Trim trim(int patch) const {
        const auto n = static_cast<std::size_t>(patch);
        return n < trims.size() ? trims[n] : geometry::Trim{};
    }
    friend bool operator==(const SurfaceInput&, const SurfaceInput&) = default;
};

/// The constants of the thesis's machine (its dialog Tool Set), mm; a, b, c are the workpiece offset.
struct ToolSetInput {
    double e = 0.08;     ///< eccentricity of the tilt axis
    double OF = 119.644; ///< tool tip to machine base
    double AB = 251.286; ///< rotary table to tilt axis
    double B4 = 371.943; ///< tilt axis to machine base

    friend bool operator==(const ToolSetInput&, const ToolSetInput&) = default;
};

struct MachineInput {
    std::string file = "rotary-tilt-listing"; ///< id of a shipped machine, or a path relative to the project
    std::optional<Vec3> workpiece_offset;     ///< set-up (a, b, c), mm; the machine file's own if not set
    std::optional<ToolSetInput> tool_set;     ///< of the thesis's machine only; that of its file if not set
    kinematics::AngleMode angle_mode = kinematics::AngleMode::consistent;

    friend bool operator==(const MachineInput&, const MachineInput&) = default;
};

/// Of the one-dimensional redistribution.
struct RedistributionInput {
    double floor = 0.1;       ///< of the monitor, in its means
    int smoothing_passes = 1; ///< over the monitor

    friend bool operator==(const RedistributionInput&, const RedistributionInput&) = default;
};

/// Where the weight of the elliptic adaptation comes from.
enum class WeightSource { error, expression, mixed, w1, w2, w3, w4 };

/// Rows and columns of what is painted: at most, and where nothing has been painted yet.
inline constexpr int most_painted = 257;
inline constexpr int fresh_painted = 65;

/// Of the elliptic grid, and of the harmonic map but for its solver, LV and LO.
struct EllipticInput {
    WeightSource weight = WeightSource::error;
    std::string expression = "1 + 10*exp(-50*((u-0.5)^2+(v-0.5)^2))"; ///< used if so chosen, or mixed
    grid::MixSettings mix{};            ///< how much each reason counts, where the weight is mixed
    std::optional<grid::Field> painted; ///< by hand, 0 to 1; nothing: nowhere
    grid::Region region{};              ///< where the weight counts
    grid::EllipticMethod solver = grid::EllipticMethod::minimiser; ///< not harmonic: that is a grid method
    double adaptation = 100.0;                                     ///< LV
    double orthogonality = 0.0;                                    ///< LO
    double relaxation = 0.81;                                      ///< WW of the thesis's iteration
    double tolerance = 1e-3;                                       ///< of the residual norm
    int max_iterations = 250;                                      ///< inner, a round
    int max_rounds = 10;                                           ///< outer
    double error_change = 1e-4;   ///< delta of the outer loop: share of the mean error at the start
    int iterations_per_step = 10; ///< between two pictures, where it is watched
    bool sliding_boundary = true;
    bool any_memory = false; ///< it is made even where it takes more than half of what is free

    friend bool operator==(const EllipticInput&, const EllipticInput&) = default;
};

struct TracksInput {
    int lattice = 0;             ///< places per track to choose from; 0: max(160, 4 n)
    double error_exponent = 2.0; ///< p of the cost sum length * error^p
    double axis_weight = 0.0;    ///< mm that one degree of axis deviation counts
    int polish_sweeps = 20;

    friend bool operator==(const TracksInput&, const TracksInput&) = default;
};

/// Of the whole chain; the cost of its moves is that of the tracks.
struct ChainInput {
    int first_iterations = 300; ///< of all nodes at once, at the exponent of the tracks, at most
    int later_iterations = 150; ///< the same at each of the higher exponents
    double gap_percent = 15.0;  ///< by which the track gap may grow

    friend bool operator==(const ChainInput&, const ChainInput&) = default;
};

struct GridInput {
    int nu = 20;
    int nv = 20;
    grid::TrackDirection direction = grid::TrackDirection::along_v;
    GridMethod method = GridMethod::tracks; ///< whose nodes the program uses
    RedistributionInput redistribution;
    EllipticInput elliptic;
    TracksInput tracks;
    ChainInput chain;

    friend bool operator==(const GridInput&, const GridInput&) = default;
};

/// Which points of the surface the program touches, and in which order.
enum class StrategyInput {
    zigzag,           ///< the nodes of the grid, track after track
    iso_parametric,   ///< the same over equal steps of the parameters, whatever the grid method
    spiral,           ///< the nodes of the grid, round after round inwards
    constant_scallop, ///< its own points: tracks that leave the tool's scallop_mm between them
    fewest_points     ///< its own points: as few as keep the tolerance on each track
};

struct ToolpathInput {
    StrategyInput strategy = StrategyInput::zigzag;
    double tolerance_mm = 0.1; ///< of fewest_points: how far the tip may be off the surface curve

    friend bool operator==(const ToolpathInput&, const ToolpathInput&) = default;
};

/// How the tool goes from the end of a track to the start of the next.
enum class LinkInput { lifted, on_surface };

struct ProgramInput {
    double feed_mm_per_min = 600.0;
    double plunge_mm_per_min = 200.0;
    double spindle_rpm = 8000.0;
    LinkInput link = LinkInput::lifted;
    double link_clearance_mm = 5.0;
    double approach_clearance_mm = 20.0;

    friend bool operator==(const ProgramInput&, const ProgramInput&) = default;
};

/// Which of the axis positions that reach a pose are taken, along the whole path.
struct SequencingInput {
    toolpath::SequencingGoal goal = toolpath::SequencingGoal::nearest;
    double largest_step_deg = 0.0; ///< of a rotary axis in one move; 0: any

    friend bool operator==(const SequencingInput&, const SequencingInput&) = default;
};

struct Project {
    std::string name = "Untitled";
    SurfaceInput surface;
    MachineInput machine;
    ToolInput tool;
    GridInput grid;
    ToolpathInput toolpath;
    SequencingInput sequencing;
    ProgramInput program;
    StockInput stock; ///< of its simulation; no plan depends on it
    PlotInput plot;   ///< beside the surface
    ArmInput arm;     ///< beside both
    ProcessorInput processor;

    friend bool operator==(const Project&, const Project&) = default;
};

/// A new project on a preset surface. Throws Error if the id is unknown.
[[nodiscard]] Project project_from_preset(std::string_view preset_id);

/// What is wrong with `project` as an input, as sentences with the field's path; empty if nothing is.
[[nodiscard]] std::vector<std::string> faults_of(const Project& project);

} // namespace millwright::project
