// Shipped files that several tests of the program read.
#pragma once

namespace millwright::test {

inline constexpr const char* thesis_arc = "assets/samples/thesis-arc.ngc";
inline constexpr const char* dome_project = "assets/projects/dome.json";

} // namespace millwright::test
