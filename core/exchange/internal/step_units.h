// The unit of length of a STEP file, as the library takes it. It reads one step of a conversion: a FOOT of 12
// INCH, which are units themselves, are millimetres to it.
#pragma once

#include <StepData_StepModel.hxx>

#include <filesystem>
#include <string>
#include <vector>

namespace millwright::exchange {

/// Before the roots are transferred: makes one step of conversions of several, and tells, with entity and
/// line, where the library does not understand the unit and which one it takes then, a sentence each. Throws
/// Error with the line for a unit that is no length above zero. `text` is that of the file.
[[nodiscard]] std::vector<std::string>
settled_units(const StepData_StepModel& model, const std::string& text, const std::filesystem::path& file);

} // namespace millwright::exchange
