// The part of AppController that deals with drawings: opening one, the program that is made of it.
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/numbers.h"
#include "core/base/text.h"
#include "core/gcode/tool_comments.h"
#include "core/project/gcode_file.h"
#include "core/project/plot_settings.h"
#include "ui/actions/app_controller.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <system_error>
#include <utility>

namespace millwright::actions {

namespace {

namespace fs = std::filesystem;

/// Beside what it was made of; of what ships with the program, and where nothing can be written, in a folder
/// of the user's own.
fs::path place_of_program(const fs::path& drawing, const AppOptions& options) {
    std::error_code ignored;
    const fs::path folder = fs::weakly_canonical(drawing.parent_path(), ignored);
    const fs::path shipped = fs::weakly_canonical(options.assets, ignored);
    const auto [end, rest] = std::ranges::mismatch(shipped, folder);
    const bool ships = !options.assets.empty() && end == shipped.end();
    if (!ships && ::access(folder.c_str(), W_OK) == 0) {
        return drawing.parent_path();
    }
    const fs::path own = options.log_folder.parent_path() / "programs";
    make_folder(own);
    return own;
}

/// What was set for one drawing and would be a surprise in the next: that it is V-carved, levels, the side of
/// the cutter, hatches, links and order of strokes, the place on the machine, a frame, leave to go through
/// the plate. Tools, speeds, depths, the plate, machine and control stay.
void forget_drawing(project::PlotSettings& settings) {
    const plot::StrokePlan usual{.tool_diameter = settings.strokes.tool_diameter};
    settings.levels.clear();
    settings.strokes = usual;
    settings.drawing_use = project::DrawingUse::strokes;
    settings.origin = Vec2::Zero();
    settings.frame.reset();
    settings.through = false;
}

/// The one that a CAM program names, at its beginning; nothing of other files, or of several diameters.
std::optional<gcode::CommentTool> tool_of_comments(const fs::path& file) {
    if (!project::is_gcode_file(file) || project::holds_points(file)) {
        return std::nullopt;
    }
    constexpr std::size_t beginning = 1 << 18;
    std::string text(beginning, '\0');
    std::ifstream stream(file, std::ios::binary);
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(stream.gcount()));
    const auto tool = gcode::only_tool(gcode::tools_in_comments(text));
    const auto& setting = project::plot_number("tool_mm");
    return tool && tool->diameter >= setting.min && tool->diameter <= setting.max ? tool : std::nullopt;
}

/// mm. The tool that a comment of the plot's file names is not that of another file: what was set before that
/// file was opened is.
double own_tool_diameter(const project::History& history) {
    const project::PlotInput& plot = history.current().plot;
    const double now = plot.settings.strokes.tool_diameter;
    const auto named = tool_of_comments(plot.file);
    if (!named || !exactly_equal(named->diameter, now)) {
        return now;
    }
    project::History before = history;
    while (before.current().plot.file == plot.file && !before.undo_title().empty()) {
        before.undo();
    }
    const bool was_never_another = before.current().plot.file == plot.file;
    return was_never_another ? plot::StrokePlan().tool_diameter : own_tool_diameter(before);
}

} // namespace

void AppController::open_plot(const fs::path& file) {
    if (jobs_->view().running) {
        throw Error("a job is running; open a plot when it has ended", file);
    }
    if (!fs::is_regular_file(file)) {
        throw Error(fs::exists(file) ? "is not a file" : "there is no such file", file);
    }
    const fs::path whole = fs::absolute(file).lexically_normal();
    const bool another = history_.current().plot.file != whole;
    if (!another) {
        plot_->read_again();
    }
    const auto tool = another ? tool_of_comments(whole) : std::nullopt;
    const double own = own_tool_diameter(history_);
    edit("Open " + file.filename().string(),
         [&](project::Project& draft) {
             if (another) {
                 draft.plot.file = whole;
                 forget_drawing(draft.plot.settings);
                 draft.plot.settings.strokes.tool_diameter = tool ? tool->diameter : own;
             }
         },
         {});
    if (tool) {
        tell(view_state_,
             widgets::Severity::info,
             fmt::format(
                 "A comment in line {} gives a tool diameter of {} mm: this is now the cutter's diameter.",
                 tool->line,
                 shortest(tool->diameter)));
    }
    view_state_.side_wanted = render::StandardView::top; // drawings are read from above
    view_state_.workspace = Workspace::plot;
    view_state_.file_prompt = FilePrompt::none;
    view_state_.fit_wanted_in(Workspace::plot) = true;
    remember(file);
}

/// Another program of the plot stands where the one before it stood, in time, and does not play on.
void AppController::follow_plot() {
    guarded([&] { finish_writing_plot(); });
    const auto made = plot_->latest();
    const auto program = made ? made->program : nullptr;
    if (program == followed_plot_) {
        return;
    }
    followed_plot_ = program;
    FileView& file = view_state_.file;
    if (file.played == Played::plot) {
        file.step.reset();
        view_state_.playback.playing = false;
    } else {
        file.parked[static_cast<std::size_t>(Played::plot)].step.reset();
    }
}

void AppController::write_plot(bool to_machine) {
    writes_plot_ = to_machine;
    plot_->make_program();
    finish_writing_plot();
}

void AppController::write_plot_path() {
    const fs::path path = plot_->write_path(place_of_program(plot_->file(), options_));
    tell(view_state_, widgets::Severity::good, "Path written.", path.string());
}

void AppController::write_plot_points() {
    const fs::path points = plot_->write_points(place_of_program(plot_->file(), options_));
    tell(view_state_, widgets::Severity::good, "Points written.", points.string());
}

void AppController::finish_writing_plot() {
    const auto made = plot_->latest();
    if (!writes_plot_ || !made || !made->finished || !plot_->is_current(*made) ||
        (!made->program && !made->failure)) {
        return;
    }
    const bool to_machine = *std::exchange(writes_plot_, std::nullopt);
    if (made->failure) {
        throw Error(*made->failure);
    }
    const fs::path program = plot_->write_program(place_of_program(plot_->file(), options_));
    tell(view_state_, widgets::Severity::good, "G-code written.", program.string());
    if (to_machine) {
        view_state_.file.reading.machine = plot_->settings().machine;
        open_gcode(program);
        view_state_.workspace = Workspace::machine;
        follow_file();
    }
}

} // namespace millwright::actions
