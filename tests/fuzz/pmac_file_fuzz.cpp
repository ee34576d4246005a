// Any text as a file of PMAC commands: lines and warnings with their places, or an Error.
#include "core/pmac/driver/pmac_file.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace millwright;
    try {
        const pmac::PmacFile file =
            pmac::read_pmac_file({reinterpret_cast<const char*>(data), size}, "fuzz.ini");
        for (const pmac::PmacFile::Line& line : file.lines) {
            expects(line.number > 0 && !line.text.empty(), "a line has a place and a text");
        }
        for (const auto& found : {file.warnings, file.omissions}) {
            for (const Diagnostic& warning : found) {
                expects(warning.place.line > 0, "a warning has a place");
            }
        }
    } catch (const Error&) { // said what is wrong
        return 0;
    }
    return 0;
}
