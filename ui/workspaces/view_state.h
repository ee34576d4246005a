// What the person at the window looks at and how: everything that is neither project nor result. Losing it
// loses no work. Kept apart from the project so that undo never moves the camera.
#pragma once

#include "core/geometry/net_editing.h"
#include "core/plan/opened_program.h"
#include "core/project/project.h"
#include "ui/render/camera.h"
#include "ui/render/view_colors.h"
#include "ui/render/window_context.h"
#include "ui/viewport/scene.h"
#include "ui/widgets/notices.h"
#include "ui/widgets/theme.h"
#include "ui/workspaces/approach.h"
#include "ui/workspaces/manual_settings.h"
#include "ui/workspaces/start_prompt.h"
#include "ui/workspaces/stock_workspace.h"

#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace millwright::actions {

/// A choice of panes and layers, not a mode that hides data.
enum class Workspace { design, grid, toolpath, program, machine, processor, plot, arm };
inline constexpr int workspace_count = 8;

/// What the lower pane shows.
enum class LowerTab {
    plots,
    motion,
    listing,
    compare,
    console,
    offsets,
    settings,
    queue,
    jobs,
    log,
    motors,
    drives, ///< of the arm
    points,
    motion_program,
    motion_file, ///< of the arm
    gouges,
    collisions, ///< of the simulation
    assembler,  ///< of the processor
    microprogram
};

/// Panes that can be hidden, with their sizes in pixels at scale 1.
struct PaneSizes {
    float outline = 220.0F;
    float inspector = 350.0F;
    float lower = 190.0F;
    float processor = 270.0F;  ///< the lower pane in the Processor workspace
    float code = 330.0F;       ///< the left one there
    float layers = 330.0F;     ///< the left one in the Plot & Picture workspace
    float plot_lower = 210.0F; ///< and the lower one
    float arm_jog = 300.0F;    ///< the left one in the Arm workspace
    float arm_lower = 230.0F;  ///< and the lower one
    float listing = 350.0F;    ///< the left pane in the Program and Machine workspaces
    bool outline_shown = true;
    bool inspector_shown = true;
    bool lower_shown = true;
};

/// Where the step-through stands. Time is that of the planned trajectory, s.
struct Playback {
    double time = 0.0;
    bool playing = false;
    double speed = 1.0; ///< times real time
};

/// Whose program is played: each keeps its place while another one is looked at.
enum class Played { project, file, plot };

/// Where a program stands that is not looked at.
struct ParkedPlayback {
    Playback playback;
    std::optional<gcode::Step> step; ///< of FileView
};

/// An opened G-code file, or the program of a plot, as a person looks at it.
struct FileView {
    plan::ReadingChoice reading;          ///< for the next file, too
    Played played = Played::project;      ///< whose motion ViewState::playback is
    std::array<ParkedPlayback, 3> parked; ///< of the others, by Played
    std::optional<gcode::Step> step;      ///< chosen by hand; nothing: that of the motion
    int find_next = 0;        ///< 1: the listing, or the editor in sight, goes on to the next hit, -1: back
    bool find_wanted = false; ///< its field takes the keyboard
};

/// A file that is asked for, until the person has chosen or given up.
enum class FilePrompt {
    none,
    open,
    save_as,
    import_surface, ///< of another program
    export_surface, ///< for one
    export_stock,   ///< what a simulation has left
    open_points,    ///< taught to the arm
    save_points,
    open_motion_program, ///< of the arm's card
    save_motion_program,
    open_arm,         ///< a file of one's own
    play_motion_file, ///< of the thesis's kind: lines and arcs of the tool
    open_motion_file, ///< into the editor
    save_motion_file,
    save_motion_result, ///< the points and joints of one
    load_card_settings,
    open_assembler, ///< of the processor: text, or an image as text
    save_assembler,
    save_image,
    open_microprogram,
    save_microprogram,
    write_program ///< of the project, as G-code
};

enum class ReplacedFile { project, program };

/// A file that would be replaced, and that is not what this program read or wrote there last.
struct Replacing {
    ReplacedFile what = ReplacedFile::project;
    std::filesystem::path file;
};

/// What the window of help shows; none: it is closed.
enum class HelpPage { none, workspace, keys, commands, about };

/// A result that a person keeps to compare later ones with: of another grid, machine, set-up or tool.
struct KeptResult {
    std::string name;         ///< "Tracks on ac-table"
    std::string place;        ///< "part at 0, 0, 50 mm"
    project::Project project; ///< that it was made of
    std::shared_ptr<const geometry::Surface> surface;
    std::shared_ptr<const plan::CuttingSetup> cutting_setup;
    std::shared_ptr<const plan::Evaluation> evaluation;
    std::shared_ptr<const plan::CutStudy> cut; ///< null where there is none
    std::vector<toolpath::SingularPoint> singular_points;
};

/// What is shown beside the result: another grid's, the one that was kept, or the designed surface alone.
struct CompareWith {
    std::optional<project::GridMethod> method;
    bool kept = false;
    bool design = false;

    [[nodiscard]] bool any() const { return kept || method || design; }
    friend bool operator==(const CompareWith&, const CompareWith&) = default;
};

/// The search for the part's place on the table: how it is done, and which place of its map is marked.
struct SetUpView {
    plan::SetUpStudySettings settings;
    std::optional<toolpath::SetUpPlace> place; ///< nothing: the best
};

/// The tool on the surface in the Grid workspace.
struct SurfaceToolView {
    viewport::SurfaceToolKind kind = viewport::SurfaceToolKind::none;
    double radius_mm = 10.0; ///< of the brush
    double strength = 0.5;   ///< of a dab
    bool erases = false;
    std::vector<Vec2> draft; ///< corners of an outline in the making
};

struct OpenDialogs {
    bool colors = false; ///< chooses ViewState::colors
    bool gouges = false; ///< is a program written that gouges the part?
    bool quit = false;   ///< a job is running: is it to be stopped?
    bool search = false; ///< the palette opens in the next frame
};

struct ViewState {
    Workspace workspace = Workspace::design;
    std::array<viewport::Layers, workspace_count> layers;    ///< one per workspace
    std::vector<viewport::ControlPointId> selected;          ///< ascending
    geometry::NetSymmetry symmetry;                          ///< of what is done to control points
    project::GridMethod shown = project::GridMethod::tracks; ///< whose path and error are drawn
    /// The program's path instead, where its strategy makes another one than the zigzag over its grid.
    bool own_path_shown = true;
    CompareWith compare_with;
    std::shared_ptr<const KeptResult> kept; ///< null before one was
    viewport::ErrorScale error;
    SetUpView set_up;
    StockChoice stock;
    SurfaceToolView surface_tool;
    bool four_views = false;
    Playback playback;
    FileView file;
    ManualSettings manual;
    StartAt start_at; ///< of the next job
    std::array<LowerTab, workspace_count> lower_tabs{LowerTab::plots,
                                                     LowerTab::plots,
                                                     LowerTab::plots,
                                                     LowerTab::motion,
                                                     LowerTab::console,
                                                     LowerTab::plots,
                                                     LowerTab::log,
                                                     LowerTab::motors};
    PaneSizes panes;
    render::WindowPlace window; ///< as it is; the app looks
    /// Where a file was last opened or saved, by what it was for (panels::use_of).
    std::map<std::string, std::filesystem::path> folders;
    widgets::Theme theme = widgets::Theme::dark;
    render::LayerColors colors; ///< chosen by a person, in place of the theme's
    double machine_speed = 1.0; ///< of the virtual machine, times real time
    OpenDialogs dialogs;
    FilePrompt file_prompt = FilePrompt::none;
    std::optional<Replacing> replacing; ///< waits for the person's word
    HelpPage help = HelpPage::none;
    std::shared_ptr<const StartWish> start; ///< a job that waits for a person's word; null: none
    int start_answer = 0; ///< CommandAnswer::number of the controller's own check of it; 0: not asked for
    /// The view of that workspace is fitted as soon as there is something to be seen in it.
    std::array<bool, workspace_count> fit_wanted{true, true, true, true, true, true, true, true};
    std::optional<render::StandardView> side_wanted; ///< look at it from there in the next frame
    bool against_light = false;                      ///< how a finished plot is looked at
    bool picture_shown = false;                      ///< below its path, in place of how it will look
    bool quit = false;                               ///< nothing is in the way any more: close the window
    std::vector<widgets::Notice> notices;            ///< to be shown; taken by the window
    std::vector<std::string> log;                    ///< every notice, newest last

    [[nodiscard]] viewport::Layers& layers_now() { return layers[static_cast<std::size_t>(workspace)]; }
    [[nodiscard]] LowerTab& lower_tab_now() { return lower_tabs[static_cast<std::size_t>(workspace)]; }
    [[nodiscard]] LowerTab lower_tab_now() const { return lower_tabs[static_cast<std::size_t>(workspace)]; }
    [[nodiscard]] const viewport::Layers& layers_now() const {
        return layers[static_cast<std::size_t>(workspace)];
    }
    [[nodiscard]] bool& fit_wanted_in(Workspace where) { return fit_wanted[static_cast<std::size_t>(where)]; }
    [[nodiscard]] bool fit_wanted_now() const { return fit_wanted[static_cast<std::size_t>(workspace)]; }
};

/// With the layers that people expect in each workspace.
[[nodiscard]] ViewState new_view_state();

/// There is another project to be seen, or another program in its place.
void fit_project(ViewState& view_state);
void fit_program(ViewState& view_state);

/// From now on the zigzag over that grid is drawn, with its error.
void show_grid(ViewState& view_state, project::GridMethod method);

/// Shows a notice and keeps it in the log.
void tell(ViewState& view_state, widgets::Severity severity, std::string text, std::string place = {});

} // namespace millwright::actions
