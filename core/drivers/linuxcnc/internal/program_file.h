// A program as LinuxCNC is given it: with a message at its end that LinuxCNC sends when everything before it
// has been executed. Nothing else in its protocol tells a program that ended from one that was ended.
#pragma once

#include "core/program/listing.h"

#include <filesystem>
#include <string>

namespace millwright::drivers::linuxcnc {

struct ProgramFile {
    std::string text;
    std::string end_mark; ///< the message
    bool in_order = true; ///< no subroutines or loops: lines are executed one after another, each once
    int end_line = 0;     ///< of the listing, before which the mark stands
};

/// Throws Error naming `file` if the program has no M2, M30 or closing %.
[[nodiscard]] ProgramFile
program_file(const program::Listing& listing, const std::filesystem::path& file, int number);

} // namespace millwright::drivers::linuxcnc
