// What a simulation has left, as a file of triangles for other programs. Lengths mm.
#pragma once

#include "core/plan/stock_simulation.h"

#include <filesystem>
#include <string>

namespace millwright::actions {

/// Whether the name ends in .stl, .ply or .glb.
[[nodiscard]] bool is_stock_file(const std::filesystem::path& file);

/// By the end of the name: .stl (binary), .ply (binary, a colour a point), .glb (a colour a triangle).
/// Colours are those of the view. Throws Error for other names, and where nothing is left.
[[nodiscard]] std::string
stock_file_bytes(const plan::StockPicture& picture, double tolerance, const std::filesystem::path& file);

} // namespace millwright::actions
