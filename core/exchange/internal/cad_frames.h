// What the process that reads a STEP or IGES file says to the one that wants it: frames of a kind, a length
// and bytes, in the byte order of the machine on which both run.
#pragma once

#include "core/exchange/cad_file.h"

#include <optional>
#include <string>
#include <string_view>

namespace millwright::exchange {

enum class FrameKind : char {
    progress = 'P', ///< a double, 0 to 1
    error = 'E',    ///< the message, a zero byte, the hint
    model = 'M'
};

struct Frame {
    FrameKind kind = FrameKind::progress;
    std::string bytes;
};

[[nodiscard]] std::string framed(const Frame& frame);
/// Takes the first whole frame out of `stream`; nothing if there is none yet. Throws Error for an unknown
/// kind.
[[nodiscard]] std::optional<Frame> take_frame(std::string& stream);

[[nodiscard]] std::string packed(const CadModel& model);
/// Throws Error for bytes that are no whole model.
[[nodiscard]] CadModel unpacked(std::string_view bytes);

} // namespace millwright::exchange
