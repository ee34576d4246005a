// Programs that gouge the part are not written and not run, unless that is allowed.
#pragma once

#include "app/command_line/command.h"
#include "core/base/error.h"

#include <string>

namespace CLI {
class App;
} // namespace CLI

namespace millwright::app {

/// A program that gouges the part, and was neither written nor run. Exit code 3.
class GougeError final : public Error {
public:
    using Error::Error;
};

/// Adds --allow-gouges to `command`.
void add_gouges_option(CLI::App& command, bool& allowed);

/// How the program of `plan` gouges the part, as plan::gouge_text(); empty if it does not, if the tool is
/// a point, or if `plan` has no cut study.
[[nodiscard]] std::string gouges_of(const OpenedProject& opened, const plan::Plan& plan);

/// Says what `gouges` says: as a warning where that is allowed, else throws GougeError with what was not
/// done ("program.ngc was not written"). Nothing if it is empty.
void answer_for_gouges(const OpenedProject& opened,
                       const std::string& gouges,
                       bool allowed,
                       const std::string& not_done);

} // namespace millwright::app
