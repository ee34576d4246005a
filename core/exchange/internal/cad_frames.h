// What the process that reads a STEP or IGES file says to the one that wants it: frames of a kind, a length
// and bytes, in the byte order of the machine on which both run.
#pragma once

#include "core/base/error.h"
#include "core/base/progress.h"
#include "core/exchange/cad_file.h"

#include <optional>
#include <string>
#include <string_view>

namespace millwright::exchange {

enum class FrameKind : char {
    progress = 'P', ///< the fraction, what is being done
    error = 'E',    ///< the line, the message, the hint
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

[[nodiscard]] Frame progress_frame(const Progress::Report& report);
[[nodiscard]] Frame error_frame(const Diagnostic& diagnostic);
/// What such a frame tells. Throws Error for one of other bytes.
[[nodiscard]] Progress::Report told_progress(const Frame& frame);
/// The same; its place has the line alone.
[[nodiscard]] Diagnostic told_error(const Frame& frame);

[[nodiscard]] std::string packed(const CadModel& model);
/// Throws Error for bytes that are no whole model.
[[nodiscard]] CadModel unpacked(std::string_view bytes);

} // namespace millwright::exchange
