// The two forms in which the thesis's programs keep a grid.
#pragma once

#include "core/grid/grid_file.h"

#include <map>
#include <string>

namespace millwright::app {

using GridForm = grid::FileForm;
inline const std::map<std::string, GridForm> grid_forms{{"pairs", GridForm::pairs},
                                                        {"blocks", GridForm::blocks}};

[[nodiscard]] inline std::string grid_text(const grid::NodeArray& nodes, GridForm form) {
    return form == GridForm::pairs ? grid::pairs_text(nodes) : grid::blocks_text(nodes);
}

} // namespace millwright::app
