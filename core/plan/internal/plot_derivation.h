// Deriving what comes of a plot, part by part.
#pragma once

#include "core/base/progress.h"
#include "core/plan/plot_work.h"

#include <filesystem>
#include <optional>
#include <vector>

namespace millwright::plan {

class PlotDerivation {
public:
    /// All of them stay the caller's.
    PlotDerivation(PlotResult& result, const std::filesystem::path& assets, const Progress& progress)
        : result_(result), settings_(result.input.settings), assets_(assets), progress_(progress) {}

    /// Each throws Error or Cancelled. The path comes first.
    void make_path();
    /// None where nothing is cut, or where a point cuts.
    void make_look();
    /// Notes the speeds that the machine does not reach.
    void check_speeds();
    /// Into `folder`.
    void make_program(const std::filesystem::path& folder);
    /// How long the drawing takes without filling, order and links; says in a notice why it cannot be run.
    void time_as_drawn();
    [[nodiscard]] bool wants_program() const { return result_.path->size() <= most_points_at_once; }

private:
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
    const Progress& progress_;
    plot::CutPath as_drawn_; ///< of strokes
};

} // namespace millwright::plan
