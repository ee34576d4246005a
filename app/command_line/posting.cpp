#include "app/command_line/posting.h"

#include "app/command_line/option_values.h"
#include "core/base/counted.h"
#include "core/posts/post_file.h"
#include "core/project/assets.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <utility>
#include <vector>

namespace millwright::app {

void add_feed_options(CLI::App& command, double& feed, double& plunge) {
    command.add_option("--feed", feed, "Cutting feed rate, mm/min")
        ->check(above_zero())
        ->capture_default_str();
    command.add_option("--plunge", plunge, "Plunge feed rate, mm/min")
        ->check(above_zero())
        ->capture_default_str();
}

void add_spindle_option(CLI::App& command, double& speed) {
    command.add_option("--spindle", speed, "Spindle speed, rpm (0: no spindle)")
        ->check(not_below_zero())
        ->capture_default_str();
}

CLI::Option& add_post_options(CLI::App& command, PostChoice& choice) {
    constexpr double coarsest = 1.0;
    command.add_option("--arcs", choice.arc_tolerance, "Fit arcs within this distance of the moves, mm")
        ->check(CLI::Range(0.0, coarsest));
    command.add_flag("--line-numbers", choice.line_numbers, "Number the lines");
    return *command.add_option("--post", choice.post, "Shipped post or post file")->type_name("NAME|FILE");
}

namespace {

/// At the top of a program for tip control, whose own header is about the axes.
constexpr const char* tip_remark = "X Y Z are positions of the tool tip, for any tool length; a distance "
                                   "in this header is without tip control";

/// Of a canned cycle: the program has not asked for its path mode.
bool is_of_cycle(const program::Block& block) {
    return block.path && block.path->of_cycle;
}

/// mm by which corners may be rounded: as the first move that says it has it, else the usual.
double path_tolerance_of(const program::Program& program) {
    const double usual = posts::TextSettings{}.path_tolerance;
    for (const program::Block& block : program.blocks) {
        if (block.moves() && block.path && !is_of_cycle(block)) {
            const bool blends = block.path->mode == program::PathMode::continuous;
            const double tolerance = block.path->tolerance > 0.0 ? block.path->tolerance : usual;
            return blends ? tolerance : 0.0;
        }
    }
    return usual;
}

bool path_mode_changes(const program::Program& program) {
    const program::Block* first = nullptr;
    for (const program::Block& block : program.blocks) {
        if (!block.moves() || is_of_cycle(block)) {
            continue;
        }
        first = first == nullptr ? &block : first;
        if (!(block.path == first->path)) {
            return true;
        }
    }
    return false;
}

} // namespace

PostedText posted(const program::Program& program,
                  const kinematics::MachineModel& machine,
                  const PostChoice& choice,
                  const std::string& name,
                  const std::string& remark) {
    const std::filesystem::path file =
        project::post_path(choice.post, std::filesystem::current_path(), project::assets_folder());
    PostedText result{posts::read_post(file), {}, path_mode_changes(program)};
    std::vector<std::string> top;
    if (!remark.empty()) {
        top.push_back(remark);
    }
    if (result.format.positions == posts::PositionsOf::tip) {
        top.emplace_back(tip_remark);
    }
    result.text = posts::release(program,
                                 machine,
                                 result.format,
                                 {.text = {.name = posts::text_name(name),
                                           .line_numbers = choice.line_numbers,
                                           .path_tolerance = path_tolerance_of(program),
                                           .remarks = std::move(top)},
                                  .arc_tolerance = choice.arc_tolerance,
                                  .tip_tolerance = choice.tip_tolerance,
                                  .file = name + "." + result.format.extension});
    return result;
}

void print_notes(const PostedText& posted) {
    if (posted.format.positions == posts::PositionsOf::tip) {
        fmt::print(stderr,
                   "{}: the tool tip moves straight from block to block, at most {:.4f} mm from the path of "
                   "linear axis moves\n",
                   posted.format.name,
                   posted.text.tip_deviation);
    }
    if (posted.path_mode_changes) {
        fmt::print(stderr,
                   "the path mode (G61, G64) changes within the program; only the first one is written\n");
    }
    if (posted.text.arcs > 0) {
        fmt::print(stderr, "{}\n", counted(posted.text.arcs, "arc"));
    }
}

} // namespace millwright::app
