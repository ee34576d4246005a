// Which of Millwright's JSON files this is: one that was given in place of another is called by its name.
#pragma once

#include "core/base/json.h"

#include <string_view>

namespace millwright {

/// `root` is the whole file. Throws Error at its field "format" unless that is `format`: "not a project file"
/// for a `kind` of "a project file", with what it is instead as hint. To be asked before anything else of the
/// file, since all its other fields are unknown then.
void expect_format(const JsonValue& root, std::string_view format, std::string_view kind);

} // namespace millwright
