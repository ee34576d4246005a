// What the library leaves out of a file without a word.
#pragma once

#include <XSControl_Reader.hxx>

#include <string>

namespace millwright::exchange {

/// After the roots are transferred: which faces of the file became no shape, and the first fault that the
/// library found on the way, in a sentence; empty if all did.
[[nodiscard]] std::string lost_faces(const XSControl_Reader& reader);

} // namespace millwright::exchange
