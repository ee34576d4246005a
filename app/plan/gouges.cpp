#include "app/plan/gouges.h"

#include "core/plan/cut_study.h"
#include "core/plan/gouges.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <cstdio>

namespace millwright::app {

void add_gouges_option(CLI::App& command, bool& allowed) {
    command.add_flag("--allow-gouges",
                     allowed,
                     "Accept a program that cuts deeper into the part than the tool's gouge limit");
}

std::string gouges_of(const OpenedProject& opened, const plan::Plan& plan) {
    return plan.cut ? plan::gouge_text(opened.project, *plan.cut) : std::string();
}

void answer_for_gouges(const OpenedProject& opened,
                       const std::string& gouges,
                       bool allowed,
                       const std::string& not_done) {
    if (gouges.empty()) {
        return;
    }
    if (!allowed) {
        throw GougeError(fmt::format("{}; {}", gouges, not_done),
                         opened.file,
                         "use --allow-gouges to accept it, or millwright cutter to list the lines");
    }
    fmt::print(stderr, "warning: {}\n", gouges);
}

} // namespace millwright::app
