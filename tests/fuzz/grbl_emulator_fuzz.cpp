// Any bytes to an emulated Grbl: it answers in lines, stands at a finite place, and its time ends.
#include "core/emulators/grbl/grbl_emulator.h"

#include "core/base/error.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using millwright::expects;
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    millwright::emulators::GrblEmulator grbl(
        {.surface = [](double x, double y) { return -5.0 + 0.1 * (x - y); }});
    constexpr std::size_t piece = 24;
    for (std::size_t at = 0; at < bytes.size(); at += piece) {
        grbl.receive(bytes.substr(at, piece));
        grbl.advance(0.05);
        const std::string said = grbl.take_output();
        expects(said.empty() || said.ends_with("\r\n"), "it speaks in whole lines");
        for (const double axis : grbl.position()) {
            expects(std::isfinite(axis), "it stands somewhere");
        }
    }
    return 0;
}
