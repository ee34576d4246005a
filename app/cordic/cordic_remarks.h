// What a person should know of a run on the CORDIC processor that came to its end all the same.
#pragma once

#include "app/cordic/cordic_source.h"
#include "core/cordic/processor.h"
#include "core/cordic/run_report.h"

#include <string>
#include <vector>

namespace millwright::app {

/// With the place in `file`, as far as they have one; none if all is as promised.
[[nodiscard]] std::vector<Diagnostic> remarks_on(const cordic::Processor& processor,
                                                 const cordic::RunReport& report,
                                                 const cordic_machine::CordicProgram& program,
                                                 const CordicChoice& choice,
                                                 const std::string& file);

} // namespace millwright::app
