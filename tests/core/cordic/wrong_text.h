// A text that an assembler refuses, and where.
#pragma once

namespace millwright::cordic {

struct WrongText {
    const char* text;
    int line, column;
    const char* message;
};

} // namespace millwright::cordic
