// Every command of HPGL that is known: how it is read, how many numbers it may have, who follows it.
#pragma once

#include "core/hpgl/internal/run.h"

#include <cstddef>
#include <span>
#include <string_view>

namespace millwright::hpgl::internal {

using Handler = void (*)(Run& run, const Given& given);

/// How many numbers a command may have: from `least` to `most`, in steps.
struct Count {
    std::size_t least = 0;
    std::size_t most = 0;
    std::size_t step = 1;

    [[nodiscard]] bool allows(std::size_t count) const {
        return count >= least && count <= most && (count - least) % step == 0;
    }
};

struct CommandRow {
    std::string_view name;
    Arguments arguments = Arguments::numbers;
    Count count;
    Handler follow = nullptr; ///< none: it is left out
    bool moves = false;       ///< the pen: where this is wrong, its position is unknown
    bool places = false; ///< where coordinates lie: where this is wrong, none are known until it is put right
    std::string_view why = {}; ///< it is left out
};

/// Nothing for two letters that are no command.
[[nodiscard]] const CommandRow* find_command(std::string_view name);
[[nodiscard]] Arguments arguments_of(std::string_view name);
[[nodiscard]] std::span<const CommandRow> all_commands();

} // namespace millwright::hpgl::internal
