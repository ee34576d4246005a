// Which records a machine takes whose targets come in a format of its own.
#pragma once

#include "core/drivers/stream/record_format.h"

#include <optional>
#include <string>

namespace CLI {
class App;
} // namespace CLI

namespace millwright::app {

struct RecordChoice {
    std::string pattern; ///< empty: none
    std::string ending = "lf";
    drivers::RecordFormat format = {};
};

/// Adds --record, --ending, --relative, --answer and --patience to `command`.
void add_record_options(CLI::App& command, RecordChoice& choice);

/// Nothing if no record was named.
[[nodiscard]] std::optional<drivers::RecordFormat> record_of(const RecordChoice& choice);

} // namespace millwright::app
