#include "core/plan/internal/posted_plot.h"

#include "core/kinematics/machine_file.h"
#include "core/plot/plot_program.h"
#include "core/posts/post_file.h"
#include "core/project/assets.h"

#include <string>
#include <utility>

namespace millwright::plan {

plot::ToolTips tips_of(const PlotResult& result) {
    const project::PlotSettings& settings = result.input.settings;
    plot::ToolTips tips;
    tips.usual = project::is_cut_by_tip(result.input)
                     ? settings.tip
                     : plot::ToolTip{.kind = plot::TipKind::flat, .diameter = settings.strokes.tool_diameter};
    for (const auto& [tool, diameter] : plot::tool_diameters(result.levels)) {
        tips.others[tool] = {.kind = plot::TipKind::flat, .diameter = diameter};
    }
    return tips;
}

PostedPlot
posted_plot(const PlotResult& result, const plot::CutPath& path, const std::filesystem::path& assets) {
    const project::PlotSettings& settings = result.input.settings;
    const std::filesystem::path folder = result.input.file.parent_path();
    kinematics::MachineModel machine =
        kinematics::read_machine(project::machine_path(settings.machine, folder, assets));
    plot::expect_on_table(path, machine, settings.origin);
    const program::Program program =
        plot::plot_program(path,
                           {.machine = machine.name(),
                            .axes = plot::plot_axes(machine),
                            .header = {"made of: " + result.input.file.filename().string()},
                            .spindle_rpm = result.spindle_rpm(),
                            .tips = tips_of(result)});
    posts::PostFormat format = posts::read_post(project::post_path(settings.post, folder, assets));
    const std::string name = result.input.file.stem().string();
    const std::filesystem::path file = name + "." + format.extension;
    posts::ReleasedText released =
        posts::release(program, machine, format, {.text = {.name = posts::text_name(name)}, .file = file});
    return {std::move(machine), std::move(format), std::move(released), file};
}

} // namespace millwright::plan
