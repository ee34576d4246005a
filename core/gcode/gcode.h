// Programs for a machine tool: blocks in the axis coordinates of one machine, made from a tool path by the
// post-processor and written as RS-274 text (docs/reference/gcode.md).
#pragma once

#include "core/gcode/post.h"
#include "core/gcode/posts/post_file.h"
#include "core/gcode/posts/release.h"
#include "core/gcode/program.h"
#include "core/gcode/program_settings.h"
#include "core/gcode/retract.h"
#include "core/gcode/writer.h"
