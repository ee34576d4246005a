// How large a face of a STEP or IGES file is.
#pragma once

#include "core/exchange/cad_file.h"

#include <TopoDS_Face.hxx>

namespace millwright::exchange {

/// The box of what the outline leaves of the face; `shape` has its edges.
[[nodiscard]] Box3 box_of(const CadFace& face, const TopoDS_Face& shape);

} // namespace millwright::exchange
