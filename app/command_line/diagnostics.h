// What is wrong with an input, or done otherwise than it says, on the terminal: the first of it, and how much
// there is.
#pragma once

#include "core/base/error.h"

#include <vector>

namespace millwright::app {

void print_first(const std::vector<Diagnostic>& found);
void print_warnings(const std::vector<Diagnostic>& warnings);

} // namespace millwright::app
