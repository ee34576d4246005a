// What a project's part is cut from in a simulation. Lengths mm.
#pragma once

#include "core/base/progress.h"
#include "core/geometry/surface.h"
#include "core/project/stock_input.h"
#include "core/simulation/stock.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace millwright::plan {

struct NamedStock {
    simulation::Stock stock;
    std::string text; ///< for people: "box 100 x 60 x 20 mm from 0, 0, -20"
};

/// The box of all faces, and `allowance` more on every side.
[[nodiscard]] NamedStock stock_around(const geometry::Surface& surface, double allowance);

/// The box, cylinder, tube or mesh of a project, as core/simulation/spec_text.h has it, also where the box
/// around the part is chosen.
[[nodiscard]] std::string stock_text(const project::StockInput& input);

/// `input` with what `text` names in place of the box around the part. Throws Error for what is no stock.
[[nodiscard]] project::StockInput with_stock(project::StockInput input, std::string_view text);

/// A stock's text with the whole path of the mesh file that it names: a relative one is beside the files of
/// `folder`. Texts without a file stay. Throws Error for what is no stock, for a file that is not there, and
/// for a relative path where `folder` is empty: that of a project that was never saved.
[[nodiscard]] std::string with_whole_path(std::string_view text, const std::filesystem::path& folder);

/// As core/simulation/spec_text.h has it; a mesh is read from its file. Throws Error, with the place, for
/// other texts, files that cannot be read, and meshes with a fault; Cancelled.
[[nodiscard]] NamedStock stock_from(std::string_view text, const Progress& progress);

} // namespace millwright::plan
