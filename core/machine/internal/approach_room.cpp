#include "core/machine/internal/approach_room.h"

#include "core/base/error.h"
#include "core/machine/run_from_line.h"

#include <fmt/format.h>

namespace millwright::machine::internal {

void check_room_above(int first_block, int line, const std::filesystem::path& file) {
    if (!can_begin_at(first_block)) {
        throw Error(Diagnostic{
            {file, line, 0, -1},
            fmt::format("line {} is among the first {}, which the approach takes", line, approach_lines),
            "run it from its beginning"});
    }
}

} // namespace millwright::machine::internal
