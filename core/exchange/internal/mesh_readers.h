// Readers of the three kinds of mesh file. Each fills the soup, or fails about a line of its file. Ours,
// because the readers of assimp 5.2 do not come to an end on damaged headers and leak at faults.
#pragma once

#include "core/base/progress.h"
#include "core/exchange/internal/polygon_soup.h"

#include <filesystem>
#include <string_view>

namespace millwright::exchange {

/// Binary or text.
void read_stl(std::string_view bytes,
              const std::filesystem::path& file,
              PolygonSoup& soup,
              const Progress& progress);
/// Wavefront: v and f; all else is read over.
void read_obj(std::string_view bytes, PolygonSoup& soup, const Progress& progress);
/// Text or binary of either byte order: x, y, z of `vertex`, vertex_indices of `face` and `tristrips`; all
/// else is read over.
void read_ply(std::string_view bytes, PolygonSoup& soup, const Progress& progress);

} // namespace millwright::exchange
