// What the 3D view shows: plain values, and the immutable results they come from. Made anew each frame;
// results are compared by pointer, so that buffers are rebuilt only for other results. Lengths mm, angles
// rad. Frames: w workpiece, m machine, s scene (what the camera looks at). s is m where the machine is shown,
// else w.
#pragma once

#include "core/geometry/net_editing.h"
#include "core/geometry/solid.h"
#include "core/geometry/surface.h"
#include "core/grid/grid_optimiser.h"
#include "core/plan/cut_study.h"
#include "core/plan/evaluation.h"
#include "core/plan/opened_program.h"
#include "core/plan/plot_work.h"
#include "core/plan/reference_mesh.h"
#include "core/plan/set_up_work.h"
#include "core/plan/stock_simulation.h"
#include "core/plan/weight_map.h"
#include "core/toolpath/singular_points.h"
#include "ui/render/bounds.h"
#include "ui/render/color_map.h"
#include "ui/render/view.h"
#include "ui/render/view_colors.h"
#include "ui/viewport/arm_scene.h"
#include "ui/viewport/stock_section.h"

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace millwright::viewport {

enum class ViewKind { design, grid, toolpath, error, machine, produced };
inline constexpr int view_kind_count = 6;

/// The word of the command line: "design", "grid" ...
[[nodiscard]] std::string_view id(ViewKind kind);
/// For people: "Design", "Error map" ...
[[nodiscard]] std::string_view title(ViewKind kind);
/// The kind of that id; nothing if there is none.
[[nodiscard]] std::optional<ViewKind> view_kind(std::string_view id);

struct DesignLayers {
    bool surface = true;
    bool lines = false;       ///< of constant u and v, eleven each
    bool control_net = false; ///< with handles
    bool reference = false;   ///< triangles of another program beside the surface
    bool produced = false;    ///< the surface that the true path makes

    friend bool operator==(const DesignLayers&, const DesignLayers&) = default;
};

/// The surface, coloured by a value.
struct ColoredLayers {
    bool deviation = false; ///< the triangles that were fitted, by their distance from the patch
    bool errors = false;    ///< by the errors around each place
    bool scallops = false;  ///< by what the cutter leaves on it
    bool weight = false;    ///< by the weight of the elliptic functional

    friend bool operator==(const ColoredLayers&, const ColoredLayers&) = default;
};

struct GridLayers {
    bool shown = false; ///< of Scene::shown, or what is being adapted
    bool start = false; ///< of Scene::start, dim

    friend bool operator==(const GridLayers&, const GridLayers&) = default;
};

struct PathLayers {
    bool intended = false;
    bool tool_axes = false; ///< a hair along the tool at each path point
    bool errors = false;    ///< the actual path, coloured by the error of each move
    bool gouges = false;    ///< places where cutter or holder come too deep
    bool trace = false;     ///< the actual path up to `now`

    friend bool operator==(const PathLayers&, const PathLayers&) = default;
};

struct MachineLayers {
    bool bodies = false;          ///< the scene is then the machine's frame
    bool tool = false;            ///< the tool at `now`
    bool singular_points = false; ///< on the surface
    bool set_up_map = false;      ///< what other places of the part cost, and the one that is marked

    friend bool operator==(const MachineLayers&, const MachineLayers&) = default;
};

/// Of a robot arm, where the scene has one.
struct ArmLayers {
    bool body = true;
    bool reach = false;        ///< the border of where its wrist can be
    bool joint_limits = false; ///< the range of each of its joints
    bool tool_frame = false;   ///< the axes at its tool's tip

    friend bool operator==(const ArmLayers&, const ArmLayers&) = default;
};

/// What of the results is to be seen.
struct Layers {
    DesignLayers design{};
    ColoredLayers colored{};
    GridLayers grid{};
    PathLayers path{};
    MachineLayers machine{};
    ArmLayers arm{};
    bool floor = true;  ///< a ground grid below everything
    bool origin = true; ///< axes at the workpiece's origin

    friend bool operator==(const Layers&, const Layers&) = default;
};

/// What people expect to see in each view.
[[nodiscard]] Layers layers_of(ViewKind kind);
/// ... and around a robot arm.
[[nodiscard]] Layers layers_of_arm();

/// A control point of the surface, by patch, row and column.
struct ControlPointId {
    geometry::PatchId patch{0};
    int i = 0;
    int j = 0;

    friend auto operator<=>(const ControlPointId&, const ControlPointId&) = default;
};

/// Where the motion stands.
struct Moment {
    kinematics::AxisPositions axes;
    int move = 0;          ///< of `shown`'s tool path; the moves before are done. -1: not yet on the path
    double fraction = 0.0; ///< of that move, 0 to 1
};

/// Where the motion of an opened program stands.
struct ProgramMoment {
    gcode::PathPlace place;
    Vec3 tip = Vec3::Zero();
    Vec3 axis = Vec3::UnitZ(); ///< from the tip towards the spindle
    std::int64_t first = 0;    ///< points of the step: those from here ...
    std::int64_t end = 0;      ///< ... to before here

    friend bool operator==(const ProgramMoment&, const ProgramMoment&) = default;
};

/// How errors become colours.
struct ErrorScale {
    render::ColorMap map = render::ColorMap::viridis;
    std::optional<double> high;  ///< top of the colours, mm; nothing: from the shown errors
    std::optional<double> limit; ///< tolerance, mm: the top of the colours, and above it the signal colour

    friend bool operator==(const ErrorScale&, const ErrorScale&) = default;
};

enum class SurfaceToolKind { none, brush, outline };

/// What the left button has in hand on the surface, in place of pointing at the path, and what is drawn over
/// the picture for it.
struct SurfaceTool {
    SurfaceToolKind kind = SurfaceToolKind::none;
    geometry::PatchId patch{0}; ///< that it works on
    double radius_mm = 10.0;    ///< of the brush
    std::vector<Vec2> outline;  ///< corners in the parameters, of the region or in the making
    bool closed = true;         ///< the outline goes back to its first corner
};

/// Any part may be missing: a layer without its results draws nothing.
struct Scene {
    int sight = 0; ///< which of a view's cameras sees it: each number has its own; not of the picture itself
    Layers layers;
    std::shared_ptr<const geometry::Surface> surface;
    std::shared_ptr<const std::vector<geometry::Trim>> trims = nullptr; ///< one per patch; null: all whole
    std::shared_ptr<const plan::ReferenceMesh> reference = nullptr;
    std::shared_ptr<const plan::CuttingSetup> cutting_setup;
    std::vector<toolpath::SingularPoint> singular_points;
    /// Bodies of the workpiece's machine in place of the simple ones; null: it has none.
    std::shared_ptr<const std::vector<geometry::SolidBody>> machine_solids = nullptr;
    std::shared_ptr<const plan::Evaluation> shown; ///< grid, path and errors that are drawn
    std::shared_ptr<const plan::Evaluation> start; ///< the grid it began with
    std::shared_ptr<const grid::OptimiserState>
        watched; ///< an adaptation on its way; drawn in place of the grid
    std::shared_ptr<const plan::WeightMap> weight;
    std::shared_ptr<const plan::CutStudy> cut = nullptr;       ///< of the program
    std::shared_ptr<const plan::StockPicture> stock = nullptr; ///< at `now`, drawn in place of the surface
    double stock_tolerance = 0.1;                              ///< of its colours, mm
    std::optional<StockSection> stock_section = std::nullopt;  ///< across it
    std::shared_ptr<const plan::SetUpResult> set_up = nullptr; ///< of the last search
    toolpath::SetUpPlace set_up_place = toolpath::SetUpPlace::Zero(); ///< that is marked on its map
    std::shared_ptr<const plan::OpenedProgram> opened = nullptr;      ///< in place of everything above
    std::optional<ProgramMoment> opened_now = std::nullopt;
    std::shared_ptr<const plan::PlotResult> plot = nullptr; ///< its paths in place of the program's
    std::optional<Vec3> table_tip = std::nullopt; ///< mm, of a table that is played to: there the tool is
    bool against_light = false;                   ///< the finished plot as light goes through
    bool picture_shown = false; ///< in place of it, the picture that it was made of, below the path
    std::optional<ArmScene> arm = std::nullopt; ///< in place of everything else
    SurfaceTool surface_tool = {};              ///< not of the picture itself
    std::optional<Moment> now;
    std::vector<ControlPointId> selected; ///< ascending
    geometry::NetSymmetry symmetry = {};  ///< of dragging them; not of the picture itself
    ErrorScale error;
    render::LayerColors colors = {}; ///< chosen by a person
};

/// Faces that are machined as one surface, whose parameters are then those of the region; null for others,
/// and until they are joined.
[[nodiscard]] const region::Region* joined_faces(const Scene& scene);
/// What the scene's tool works on; with a surface that has such a part.
[[nodiscard]] const geometry::ParametricSurface& worked_surface(const Scene& scene);

/// Whether both look the same.
[[nodiscard]] bool operator==(const Scene& a, const Scene& b);

/// Of the opened program, else of the workpiece; null without either.
[[nodiscard]] std::shared_ptr<const kinematics::MachineModel> machine_of(const Scene& scene);

/// Where the axes stand: at `now`, else at the start of the path, else at zero. Empty without a machine.
[[nodiscard]] kinematics::AxisPositions axes_now(const Scene& scene);

/// Workpiece to machine coordinates with axes_now() where the machine is shown, else the identity.
[[nodiscard]] Frame scene_from_workpiece(const Scene& scene);

/// The same look, with the workpiece's coordinates in place of the scene's: an opened path is kept in those.
[[nodiscard]] render::View path_view(const render::View& view, const Scene& scene);

/// What is left of the stock is drawn, and covers the surface.
[[nodiscard]] bool shows_stock(const Scene& scene);

/// What gives the surface its colours: the topmost of the layers that are on and have their results. The
/// deviation colours the triangles that the surface was fitted to, which then stand in its place.
enum class SurfaceColors { plain, error, scallop, weight, deviation };
[[nodiscard]] SurfaceColors surface_colors(const Scene& scene);

/// The colours of the weight, from its least to its largest value; another map than that of the errors.
/// Throws Defect without a weight.
[[nodiscard]] render::ColorScale weight_colors(const Scene& scene);

/// The colours of the deviation of the reference, both ways to a round number not below the largest. Throws
/// Defect without a reference.
[[nodiscard]] render::ColorScale deviation_colors(const Scene& scene);
/// Of the cuts of a V-carving by their depth, mm. Throws Defect without one.
[[nodiscard]] render::ColorScale depth_colors(const Scene& scene);

/// The colours of what is left on the surface: from 0 to a round number that 95 % of it are well below; the
/// signal colour is higher, or not cut. Throws Defect without a study of the cut.
[[nodiscard]] render::ColorScale scallop_colors(const Scene& scene, const glm::vec3& over_limit);

/// The colours of the set-up's map, over all places that can be reached. Throws Defect without one.
[[nodiscard]] render::ColorScale set_up_colors(const Scene& scene);

/// The colours of the errors of `shown`: from 0 to a round number not below twice their mean, unless the
/// scene says otherwise. `over_limit` comes from the theme.
[[nodiscard]] render::ColorScale error_colors(const Scene& scene, const glm::vec3& over_limit);

} // namespace millwright::viewport
