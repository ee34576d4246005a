#include "core/studies/kinematic_study.h"

#include "core/base/error.h"
#include "core/base/sentences.h"
#include "core/plan/set_up_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

namespace millwright::studies {

namespace {

std::vector<StudyCase> cases_with(std::span<const int> points, int tracks) {
    std::vector<StudyCase> found;
    for (const char* surface : {"dome", "sine", "two-bell", "saddle"}) {
        for (const char* machine : {"rotary-tilt-listing", "bc-table-head", "ca-head"}) {
            for (const int n : points) {
                found.push_back({surface, machine, n, tracks});
            }
        }
    }
    return found;
}

project::Project project_of(const StudyCase& of) {
    project::Project project = project::project_from_preset(of.surface);
    project.machine.file = of.machine;
    project.grid.nu = of.points;
    project.grid.nv = of.tracks;
    project.grid.direction = grid::TrackDirection::along_u;
    return project;
}

StudyFigures study_figures(const plan::Evaluation& evaluation,
                           const plan::CuttingSetup& cutting_setup,
                           const Progress& progress) {
    return {evaluation.closest,
            evaluation.track_gap.value(), // of a zigzag
            evaluation.path_length,
            plan::estimated_time(evaluation, cutting_setup.machine, project::ProgramInput{}, progress),
            cutting_setup.machine.description().workpiece_offset};
}

/// Nothing where no place changes the error by more than rounding, as on machines whose rotary axes are all
/// in the head.
std::optional<plan::CuttingSetup> in_best_set_up(plan::CuttingSetup cutting_setup, const Progress& progress) {
    constexpr double rounding = 1e-6;
    const plan::SetUpStudySettings settings;
    const auto found = toolpath::search_set_up(
        plan::set_up_cost(cutting_setup, settings), plan::set_up_box(cutting_setup, settings), progress);
    if (!(found.best.cost < (1.0 - rounding) * found.start.cost)) {
        return std::nullopt;
    }
    cutting_setup.machine =
        cutting_setup.machine.with_workpiece_offset(toolpath::offset_of(found.best.place));
    return cutting_setup;
}

constexpr double visible_gain = 1e-3; // a smaller part of a figure is rounding

bool lowers_a_figure(const grid::ErrorSummary& now, const grid::ErrorSummary& before) {
    const auto lower = [](double figure, double old_figure) {
        return figure < (1.0 - visible_gain) * old_figure;
    };
    return lower(now.max, before.max) || lower(now.mean, before.mean) || lower(now.axis_max, before.axis_max);
}

/// A workpiece with its uniform grid, and rows of grids on it.
class Bench {
public:
    Bench(StudyCase of, plan::CuttingSetup cutting_setup, project::GridInput input, const Progress& progress)
        : of_(std::move(of)), cutting_setup_(std::move(cutting_setup)), input_(std::move(input)),
          uniform_(plan::evaluate(
              cutting_setup_, plan::uniform_outcome(input_), plan::report_sampling, progress)) {}

    [[nodiscard]] StudyRow uniform_row(StudyMethod method, const Progress& progress) const {
        return {of_, method, study_figures(uniform_, cutting_setup_, progress), {}};
    }
    [[nodiscard]] StudyRow
    improved_row(StudyMethod method, project::GridMethod grid_method, const Progress& progress) const {
        const plan::Evaluation found = plan::improved_evaluation(
            {grid_method, input_, cutting_setup_}, uniform_, progress.part(0.0, making));
        return row_of_grid(method, found, progress.part(making, 1.0));
    }
    /// The chain's grid, and the same with its branches and turns chosen for the least error of the path.
    [[nodiscard]] std::array<StudyRow, 2>
    chain_rows(StudyMethod chain, StudyMethod sequenced, const Progress& progress) const {
        const plan::Evaluation found = plan::improved_evaluation(
            {project::GridMethod::chain, input_, cutting_setup_}, uniform_, progress.part(0.0, making));
        return {row_of_grid(chain, found, progress.part(making, making)),
                sequenced_row(sequenced, found, progress.part(making, 1.0))};
    }

private:
    static constexpr double making = 0.9; // share of the grid in a row

    [[nodiscard]] StudyRow
    sequenced_row(StudyMethod method, const plan::Evaluation& nearest, const Progress& progress) const {
        plan::CuttingSetup sequenced = cutting_setup_;
        sequenced.sequencing.goal = toolpath::SequencingGoal::error;
        const plan::Evaluation found =
            plan::evaluate(sequenced, nearest.outcome, plan::report_sampling, progress.part(0.0, making));
        const bool worse = plan::is_worse(found, nearest, cutting_setup_.machine);
        const Progress told = progress.part(making, 1.0);
        if (!worse && lowers_a_figure(found.closest, nearest.closest)) {
            return row_of(method, found, told);
        }
        StudyRow kept = row_of(method, nearest, told);
        kept.note = worse ? "No sequence is better in every metric than the nearest branch, so it is kept."
                          : "No sequence is better in any metric, by at least a thousandth, than the nearest "
                            "branch, so it is kept.";
        kept.no_gain = true;
        return kept;
    }
    [[nodiscard]] StudyRow
    row_of(StudyMethod method, const plan::Evaluation& found, const Progress& progress) const {
        return {of_, method, study_figures(found, cutting_setup_, progress), found.outcome.note};
    }
    [[nodiscard]] StudyRow
    row_of_grid(StudyMethod method, const plan::Evaluation& found, const Progress& progress) const {
        StudyRow row = row_of(method, found, progress);
        row.no_gain = plan::keeps_grid(found, uniform_);
        return row;
    }

    StudyCase of_;
    plan::CuttingSetup cutting_setup_;
    project::GridInput input_;
    plan::Evaluation uniform_;
};

double row_score(const StudyRow& row) {
    return row.figures->error.max * row.figures->error.mean;
}

/// The search for a set-up looks at a mean error of another grid. Where it gains nothing here the part stays
/// where it was; what it costs elsewhere is said.
void compare_with_unmoved(StudyRow& row, const StudyRow& unmoved) {
    const grid::ErrorSummary& before = unmoved.figures->error;
    const grid::ErrorSummary& now = row.figures->error;
    if (!(now.mean <= before.mean && row_score(row) < (1.0 - visible_gain) * row_score(unmoved))) {
        row.figures = unmoved.figures;
        row.no_gain = true;
        row.note = fmt::format("The best position found is no better than that of \"{}\", so the part stays.",
                               label(unmoved.method));
        return;
    }
    const auto tell = [&](double old_figure, double figure, const char* name) {
        if (old_figure > 0.0 && figure > (1.0 + visible_gain) * old_figure) {
            row.loss += fmt::format(
                "{}{} +{:.1f} %", row.loss.empty() ? "" : ", ", name, 100.0 * (figure / old_figure - 1.0));
        }
    };
    tell(before.max, now.max, "largest");
    tell(before.axis_max, now.axis_max, "axis");
    if (!row.loss.empty()) {
        row.note = with_sentence(
            std::move(row.note),
            fmt::format("Worse with the set-up than with \"{}\": {}.", label(unmoved.method), row.loss));
    }
}

const StudyRow& row_with(const std::vector<StudyRow>& rows, StudyMethod method) {
    return *std::ranges::find(rows, method, &StudyRow::method);
}

/// The rows with a set-up where the part has moved, beside those without in `unmoved`.
std::vector<StudyRow>
rows_there(const Bench& there, const std::vector<StudyRow>& unmoved, const Progress& progress) {
    StudyRow uniform = there.uniform_row(StudyMethod::set_up, progress.part(0.0, 0.0));
    auto [chain, sequenced] = there.chain_rows(StudyMethod::set_up_chain, StudyMethod::everything, progress);
    compare_with_unmoved(uniform, row_with(unmoved, StudyMethod::uniform));
    compare_with_unmoved(chain, row_with(unmoved, StudyMethod::chain));
    const StudyRow& without = row_with(unmoved, StudyMethod::sequencing);
    compare_with_unmoved(sequenced, row_score(chain) < row_score(without) ? chain : without);
    return {std::move(uniform), std::move(chain), std::move(sequenced)};
}

/// The same where no place is better: the part stays.
std::vector<StudyRow> unmoved_rows(const std::vector<StudyRow>& rows) {
    const auto kept = [&](StudyMethod method, StudyMethod without) {
        StudyRow row = row_with(rows, without);
        row.method = method;
        row.note = "No position on the table changes the error by more than rounding, so the part stays.";
        row.no_gain = true;
        return row;
    };
    return {kept(StudyMethod::set_up, StudyMethod::uniform),
            kept(StudyMethod::set_up_chain, StudyMethod::chain),
            kept(StudyMethod::everything, StudyMethod::sequencing)};
}

std::vector<StudyRow> out_of_reach_rows(const StudyCase& of, const std::string& why) {
    std::vector<StudyRow> rows;
    for (const StudyMethod method : every_study_method) {
        rows.push_back({of, method, std::nullopt, why});
    }
    return rows;
}

} // namespace

std::string_view label(StudyMethod method) {
    switch (method) {
    case StudyMethod::uniform:
        return "uniform";
    case StudyMethod::redistribution:
        return "1-D shares";
    case StudyMethod::elliptic:
        return "elliptic";
    case StudyMethod::harmonic:
        return "harmonic map";
    case StudyMethod::tracks:
        return "tracks";
    case StudyMethod::chain:
        return "chain";
    case StudyMethod::sequencing:
        return "chain + sequence";
    case StudyMethod::set_up:
        return "set-up";
    case StudyMethod::set_up_chain:
        return "set-up + chain";
    case StudyMethod::everything:
        return "all three";
    }
    return {};
}

std::vector<StudyCase> full_study() {
    constexpr std::array points{15, 20, 30, 40, 60};
    return cases_with(points, 20);
}

std::vector<StudyCase> quick_study() {
    constexpr std::array points{12};
    return cases_with(points, 8);
}

std::vector<StudyRow> studied(const StudyCase& of, const plan::Folders& folders, const Progress& progress) {
    const project::Project project = project_of(of);
    const plan::CuttingSetup cutting_setup = plan::cutting_setup_of(project, folders);
    try {
        std::vector<StudyRow> rows;
        const Bench there(of, cutting_setup, project.grid, progress.part(0.0, 0.005));
        rows.push_back(there.uniform_row(StudyMethod::uniform, progress.part(0.005, 0.01)));
        rows.push_back(there.improved_row(
            StudyMethod::redistribution, project::GridMethod::redistribution, progress.part(0.01, 0.02)));
        rows.push_back(there.improved_row(
            StudyMethod::elliptic, project::GridMethod::elliptic, progress.part(0.02, 0.06)));
        rows.push_back(there.improved_row(
            StudyMethod::harmonic, project::GridMethod::harmonic, progress.part(0.06, 0.1)));
        rows.push_back(
            there.improved_row(StudyMethod::tracks, project::GridMethod::tracks, progress.part(0.1, 0.15)));
        const auto by_chain =
            there.chain_rows(StudyMethod::chain, StudyMethod::sequencing, progress.part(0.15, 0.5));
        rows.insert(rows.end(), by_chain.begin(), by_chain.end());
        const auto moved = in_best_set_up(cutting_setup, progress.part(0.5, 0.6));
        const std::vector<StudyRow> with_set_up =
            moved ? rows_there(Bench(of, *moved, project.grid, progress.part(0.6, 0.6)),
                               rows,
                               progress.part(0.6, 1.0))
                  : unmoved_rows(rows);
        rows.insert(rows.end(), with_set_up.begin(), with_set_up.end());
        return rows;
    } catch (const Error& error) {
        return out_of_reach_rows(of, error.diagnostic().message);
    }
}

} // namespace millwright::studies
