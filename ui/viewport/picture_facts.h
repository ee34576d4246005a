// What a picture of a view says in words: the figures that are always shown together, before and after.
#pragma once

#include "core/plan/plan.h"
#include "ui/viewport/scene.h"

#include <string>
#include <vector>

namespace millwright::viewport {

/// A small table. The first column names the rows; `rows` have as many cells as there are columns.
struct PictureFacts {
    std::string title;
    std::string subtitle;
    std::vector<std::string> columns; ///< with units: "max mm"
    std::vector<std::vector<std::string>> rows;
};

/// For people: "uniform", "adapted", "optimised".
[[nodiscard]] std::string_view title(project::GridMethod method);
/// The same of what the program follows: "optimised", "Spiral".
[[nodiscard]] std::string program_title(const project::Project& project);

/// Of the design the part's size and net; of all other views the errors on the machine, uniform grid first.
/// Results that the plan lacks are left out.
[[nodiscard]] PictureFacts
picture_facts(const project::Project& project, const plan::Plan& plan, ViewKind kind);

} // namespace millwright::viewport
