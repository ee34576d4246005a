// Any characters to an emulated PMAC, on-line and as programs: it stands at a finite place, and its time
// ends.
#include "core/pmac/emulator/pmac_emulator.h"

#include "core/base/error.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using millwright::expects;
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    millwright::pmac::PmacEmulator card;
    card.receive("#1->120X\r#1J/\rI5=3\rOPEN PROG 1\r");
    constexpr std::size_t piece = 24;
    for (std::size_t at = 0; at < bytes.size(); at += piece) {
        card.receive(bytes.substr(at, piece));
        card.advance(0.01);
        (void)card.take_output();
        for (int motor = 1; motor <= 8; ++motor) {
            expects(std::isfinite(card.position(motor)) && std::isfinite(card.output(motor)),
                    "a motor stands somewhere");
        }
    }
    card.receive("\rCLOSE\r&1B1R\r");
    card.advance(0.2);
    expects(std::isfinite(card.command(1)), "a motor is sent somewhere");
    return 0;
}
