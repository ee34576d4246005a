#include "app/command_line/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>

namespace millwright::app {

namespace {

constexpr std::size_t most_printed = 20;

} // namespace

void print_first(const std::vector<Diagnostic>& found) {
    for (std::size_t n = 0; n < std::min(found.size(), most_printed); ++n) {
        fmt::print(stderr, "millwright: {}\n", to_text(found[n]));
    }
}

void print_warnings(const std::vector<Diagnostic>& warnings) {
    print_first(warnings);
    if (warnings.size() > most_printed) {
        fmt::print(stderr, "millwright: {} warnings\n", warnings.size());
    }
}

} // namespace millwright::app
