// From a shape of Open CASCADE to Bezier patches.
#pragma once

#include "core/exchange/cad_file.h"

#include <TopoDS_Shape.hxx>

namespace millwright::exchange {

/// Every face of the shape, which has some. Throws Error, naming `file`, if none can be converted, or beyond
/// the limits; Cancelled.
[[nodiscard]] CadModel
faces_of(const TopoDS_Shape& shape, const std::filesystem::path& file, const Progress& progress);

} // namespace millwright::exchange
