// What a person should know of a run on the CORDIC processor that came to its end all the same.
#pragma once

#include "app/commands/cordic_source.h"
#include "core/cordic/processor.h"
#include "core/cordic/run_report.h"

#include <string>
#include <vector>

namespace millwright::app {

/// Sentences; none if all is as promised.
[[nodiscard]] std::vector<std::string> remarks_on(const cordic::Processor& processor,
                                                  const cordic::RunReport& report,
                                                  const gcode::CordicProgram& program,
                                                  const CordicChoice& choice);

} // namespace millwright::app
