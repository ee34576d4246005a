// Deriving what comes of a plot or a picture, in stages: each reads what the stages before it have made.
#pragma once

#include "core/base/progress.h"
#include "core/plan/plot_work.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

namespace millwright::plan {

class PlotDerivation {
public:
    /// All of them stay the caller's.
    PlotDerivation(PlotResult& result, const std::filesystem::path& assets, const Progress& progress)
        : result_(result), settings_(result.input.settings), assets_(assets), whole_(progress) {}

    /// Every stage. `publish` is called whenever there is more of the result to be looked at. What goes wrong
    /// is the result's failure. Throws Cancelled.
    void run(const std::function<void()>& publish);
    /// Of a result with a path: its program and what follows from that. As run().
    void run_program(const std::function<void()>& publish);

private:
    using Publish = std::function<void()>;

    struct Stage {
        std::string_view title = {}; ///< what is being done, for people; empty: as before
        double share = 0.0;          ///< of the work, relative to the other stages
        void (PlotDerivation::*make)(const Publish& publish) = nullptr; ///< throws Error or Cancelled
        bool of_program = false; ///< it is left out of a path that is too long to get one automatically
        bool shown = false;      ///< what is there is published when it has been made
        bool finishes = false;   ///< PlotResult::finished holds when it has been made
    };
    /// In the order in which they depend on each other.
    static const std::vector<Stage>& stages();
    void run(const std::vector<Stage>& stages, const Publish& publish);
    void make(const Stage& stage, const Publish& publish);

    void make_path(const Publish& publish);
    /// None where nothing is cut, or where a point cuts.
    void make_look(const Publish& publish);
    /// Notes the speeds that the machine does not reach.
    void check_speeds(const Publish& publish);
    void make_program(const Publish& publish);
    /// How long the drawing takes without filling, order and links; says in a notice why it cannot be run.
    void time_as_drawn(const Publish& publish);
    /// Reads the text of the program and plans its motion, as of every G-code file that is opened.
    void make_motion(const Publish& publish);
    [[nodiscard]] bool wants_program() const {
        return asked_for_ || result_.path->size() <= most_points_at_once;
    }

    void cut_drawing();
    void cut_program();
    void cut_points();
    void cut_picture();
    void show_picture(const plot::PictureSettings& reading, double pixel);
    void cut_relief(const plot::Picture& picture, double pitch);
    void carve_strokes(const plot::Strokes& drawn);
    void cut_strokes(const plot::Strokes& drawn, const Vec2& end);
    /// Compensated, filled, ordered and linked, for a tool that comes from the origin and goes to `end`.
    [[nodiscard]] plot::Strokes plan_strokes(const plot::Strokes& drawn, const Vec2& end);
    [[nodiscard]] plot::CutPath placed(plot::CutPath path) const;
    void use(plot::CutPath path);
    void note(std::optional<Diagnostic> notice);
    void note_raised_change();
    [[nodiscard]] plot::CutSettings cut_of(std::vector<plot::Level> levels) const;
    [[nodiscard]] std::vector<plot::Level> levels_of(const plot::Strokes& strokes) const;

    PlotResult& result_;
    const project::PlotSettings& settings_;
    const std::filesystem::path& assets_;
    const Progress& whole_;
    Progress progress_;      ///< of the stage
    plot::CutPath as_drawn_; ///< of strokes
    bool asked_for_ = false; ///< a person asked for the program
};

} // namespace millwright::plan
