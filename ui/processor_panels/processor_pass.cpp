#include "ui/processor_panels/processor_pass.h"

#include "core/base/error.h"
#include "core/cordic_study/single_pass.h"
#include "ui/widgets/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace millwright::panels {

namespace {

using cordic::CoordinateSystem;
using cordic::Mode;

constexpr std::array<CoordinateSystem, 3> pass_systems{
    CoordinateSystem::circular, CoordinateSystem::linear, CoordinateSystem::hyperbolic};
constexpr std::array<widgets::Option, 3> pass_system_options{
    {{"circular", "Circular", {}, "m = 1: cosine and sine; magnitude and angle"},
     {"linear", "Linear", {}, "m = 0: product; quotient"},
     {"hyperbolic", "Hyperbolic", {}, "m = -1: cosh and sinh; square root and atanh"}}};
constexpr std::array<widgets::Option, 2> pass_mode_options{
    {{"rotation", "Rotation", {}, "CORDIC-R: z goes to 0"},
     {"vectoring", "Vectoring", {}, "CORDIC-V: y goes to 0"}}};

constexpr double most_input = 1e6;
constexpr widgets::FieldInfo pass_x{"x", "x", {}, "Input value", -most_input, most_input, 1.0, 6};
constexpr widgets::FieldInfo pass_y{"y", "y", {}, "Input value", -most_input, most_input, 0.0, 6};
constexpr widgets::FieldInfo pass_z{
    "z", "z", {}, "Input value, rad; dimensionless in the linear system", -most_input, most_input, 0.5, 6};

const char* pass_formula(CoordinateSystem m, Mode mode) {
    const bool rotates = mode == Mode::rotation;
    switch (m) {
    case CoordinateSystem::linear:
        return rotates ? "y + x z" : "z + y/x";
    case CoordinateSystem::hyperbolic:
        return rotates ? "x cosh z + y sinh z, y cosh z + x sinh z"
                       : "sqrt(x\u00b2 - y\u00b2), z + atanh(y/x)";
    case CoordinateSystem::circular:
        break;
    }
    return rotates ? "x cos z - y sin z, y cos z + x sin z" : "sqrt(x\u00b2 + y\u00b2), z + atan(y/x)";
}

/// What is left of z (rotation) or y (vectoring) behind each step.
void draw_left(Ui& ui, Mode mode, const cordic::SinglePass& pass) {
    std::vector<double> steps;
    std::vector<double> left;
    for (const cordic::PassStep& step : pass.steps) {
        if (!step.corrects) {
            steps.push_back(static_cast<double>(steps.size()));
            left.push_back(std::abs(mode == Mode::rotation ? step.z : step.y));
        }
    }
    const std::array<widgets::Series, 1> series{{{"residual", steps, left, 0, false}}};
    widgets::PlotView view;
    view.x_label = "step";
    view.y_label = mode == Mode::rotation ? "residual z" : "residual y";
    view.y_is_log = true;
    view.series = series;
    view.height = ui.px(140.0F);
    (void)widgets::line_plot(ui, "left", view);
}

} // namespace

void ProcessorPass::draw(Ui& ui, const actions::ProcessorChoice& choice) {
    const auto section = ui.section("pass", "Single CORDIC pass");
    if (!section) {
        return;
    }
    draw_input(ui);
    draw_result(ui, choice);
}

void ProcessorPass::draw_input(Ui& ui) {
    const auto system = std::ranges::find(pass_systems, m_) - pass_systems.begin();
    if (const auto chosen = ui.choice("system", "System", static_cast<int>(system), pass_system_options)) {
        m_ = pass_systems[static_cast<std::size_t>(*chosen)];
    }
    if (const auto chosen = ui.segmented("mode", "Mode", static_cast<int>(mode_), pass_mode_options)) {
        mode_ = *chosen == 0 ? Mode::rotation : Mode::vectoring;
    }
    const auto can_fold = m_ == CoordinateSystem::circular
                              ? widgets::Permission{}
                              : widgets::Permission::refused("Folding applies to the circular system only.");
    if (const auto on = ui.toggle("folds",
                                  "Fold",
                                  folds_,
                                  "Quadrant folding: Pre before the pass, Post after a rotation",
                                  can_fold)) {
        folds_ = *on;
    }
    const auto edit = [&](double& number, const widgets::FieldInfo& info) {
        number = ui.number(number, info).value_or(number);
    };
    edit(x_, pass_x);
    edit(y_, pass_y);
    edit(z_, pass_z);
}

void ProcessorPass::draw_result(Ui& ui, const actions::ProcessorChoice& choice) const {
    const cordic::Sequence sequence =
        choice.iterations > 0 ? cordic::classic_sequence(m_, choice.iterations) : cordic::thesis_sequence(m_);
    const cordic::PassInput input{.mode = mode_,
                                  .x = x_,
                                  .y = y_,
                                  .z = z_,
                                  .folds = folds_ && m_ == CoordinateSystem::circular,
                                  .zero = choice.matlab_zero ? cordic::SignOfZero::zero
                                                             : cordic::SignOfZero::positive};
    ui.note(pass_formula(m_, mode_));
    try {
        const cordic::SinglePass pass = cordic::single_pass(choice.format, sequence, input);
        ui.value("x_out", "x after", fmt::format("{:.9g}", pass.x));
        ui.value("y_out", "y after", fmt::format("{:.9g}", pass.y));
        ui.value("z_out", "z after", fmt::format("{:.9g}", pass.z));
        const bool rotates = mode_ == Mode::rotation;
        ui.value("error", rotates ? "Error of (x, y)" : "Error of x", fmt::format("{:.3g}", pass.error));
        ui.value("z_error", rotates ? "Residual z" : "Error of z", fmt::format("{:.3g}", pass.z_error));
        if (const auto range = cordic::exceeded_range(choice.format, sequence, input)) {
            ui.value("range", "Outside the range", fmt::format("|z| <= {:.5f} rad", *range));
        }
        draw_left(ui, mode_, pass);
    } catch (const Error& error) {
        ui.text(to_text(error.diagnostic()));
    }
}

} // namespace millwright::panels
