// What a person wrote for the CORDIC processor: assembler text and a microprogram of one's own.
#pragma once

#include <string>

namespace millwright::project {

struct ProcessorInput {
    std::string assembler;
    std::string microprogram;

    friend bool operator==(const ProcessorInput&, const ProcessorInput&) = default;
};

} // namespace millwright::project
