// What comes of a plot or a picture that is to be cut, derived in the background: its path, how the work
// looks, its program, and how that moves the machine. Lengths mm, angles rad, speeds mm/s.
#pragma once

#include "core/base/error.h"
#include "core/gcode/preview_path.h"
#include "core/plan/opened_program.h"
#include "core/plan/pipeline.h"
#include "core/plot/cut_path.h"
#include "core/plot/picture/height_field.h"
#include "core/plot/picture/picture.h"
#include "core/plot/point_file.h"
#include "core/plot/work_time.h"
#include "core/program/listing.h"
#include "core/program/program.h"
#include "core/project/plot_input.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace millwright::plan {

/// Of a point file, where they lie on the machine, with the text that their lines are of.
struct PlotPoints {
    std::string text;
    plot::PointFile read;
};

/// A picture as it is read, for people to look at: all of its file, whatever region is cut.
struct ShownPicture {
    plot::Picture picture;      ///< squares of the mean brightness, at most 65,536
    Vec2 cell = Vec2::Ones();   ///< width and height of one, mm
    Vec2 corner = Vec2::Zero(); ///< middle of the lower left one on the machine, mm

    /// 0 to 255, as the thesis of 2006 has G(i,j): row i from the top, column j from the left.
    [[nodiscard]] int gray(int i, int j) const { return picture.at(i, j) / 257; }
};

/// Posted for the machine and the control of the settings, and read back.
struct PlotProgram {
    std::string name; ///< "sign.ngc": of the file that it would be
    std::shared_ptr<const program::Program> program;
    std::shared_ptr<const program::Listing> listing; ///< of that program
};

/// Everything known of an opened plot at one moment. Immutable once published; parts that are not there yet
/// are null or empty.
struct PlotResult {
    project::PlotInput input;
    bool picture = false;
    std::vector<Diagnostic> notices;                   ///< of the reader, and of what is cut
    Vec2 picture_size = Vec2::Zero();                  ///< of a picture, mm
    std::shared_ptr<const ShownPicture> shown_picture; ///< null: it is none
    double step_over = 0.0;                            ///< of a relief, mm
    std::optional<Diagnostic> failure;
    std::vector<plot::Level> levels; ///< in force, of plots and outlines
    std::size_t drawn_strokes = 0;
    plot::WorkTime as_drawn, as_planned; ///< by the thesis's model, level by level
    double program_rpm = 0.0;            ///< of a G-code program's spindle, 1/min; 0: it does not say
    std::shared_ptr<const plot::CutPath> path;
    std::shared_ptr<const PlotPoints> points; ///< of a point file, which a table plays as they are
    plot::PathLengths lengths;
    /// What is cut, a level each; a relief's one; of a path file one per tool; of a V-carving by depth.
    struct LevelPath {
        int pen = 1;                      ///< or the tool
        std::optional<double> depth = {}; ///< of moves of about this depth, mm; not given: of any
        gcode::PreviewPath path;
    };
    std::vector<LevelPath> cuts;
    gcode::PreviewPath air; ///< where the tool travels
    /// What stands when it is cut, at most 160 squares long, and the light that goes through half a
    /// millimetre more than the cut.
    std::shared_ptr<const plot::HeightField> look;
    plot::GrayImage light;
    std::shared_ptr<const PlotProgram> program;  ///< null: none
    std::shared_ptr<const OpenedProgram> opened; ///< that program, and how it moves the machine
    bool finished = false;                       ///< all but how the program moves the machine
    std::uint64_t revision = 0;                  ///< grows with every publication
    std::uint64_t request = 0;                   ///< which request it answers, see PlotWorker::request
    std::optional<plot::CarvingFigures> carved;  ///< of a V-carving
    bool cut_as_drawn = false;                   ///< filling, order and links change nothing
    /// By the planner, as drawn, s; nullopt where it is cut as drawn, where that cannot be run, or where
    /// there is no automatic program.
    std::optional<double> drawn_seconds;

    /// Of the spindle, 1/min: what is set, else the program's, else the usual speed.
    [[nodiscard]] double spindle_rpm() const {
        return input.settings.spindle_rpm.value_or(program_rpm > 0.0 ? program_rpm
                                                                     : project::usual_spindle_rpm);
    }
};

/// Longer paths get no program before a person asks for it.
inline constexpr std::size_t most_points_at_once = 100'000;

/// One file at a time, on a thread of its own. Called from the owner's thread; every member returns at once.
class PlotWorker {
public:
    /// `wake` is called from the worker whenever something new can be looked at.
    PlotWorker(std::filesystem::path assets, std::function<void()> wake);
    PlotWorker(const PlotWorker&) = delete;
    PlotWorker& operator=(const PlotWorker&) = delete;
    ~PlotWorker();

    /// Derives what does not hold any more: since its input has changed, or a file that it names. What is
    /// shown stays until something new is there. The number of the request, from 1.
    std::uint64_t request(const project::PlotInput& input);
    /// The same, but everything anew.
    std::uint64_t request_anew(const project::PlotInput& input);
    /// Of a path that is too long to get one automatically; published as the rest.
    void request_program();
    void cancel();

    /// Null while none is open.
    [[nodiscard]] std::shared_ptr<const PlotResult> latest() const;
    [[nodiscard]] Activity activity() const;
    void wait_idle() const;

private:
    class Worker;
    std::uint64_t ask(const project::PlotInput& input, bool anew);

    std::unique_ptr<Worker> worker_;
    std::uint64_t requests_ = 0;
};

} // namespace millwright::plan
