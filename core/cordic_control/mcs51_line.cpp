#include "core/cordic_control/mcs51_line.h"

#include "core/base/error.h"
#include "core/cordic_control/mcs51.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstddef>
#include <optional>

namespace millwright::cordic {
namespace {

constexpr std::int64_t most_mcs51_clocks = 100'000'000;
constexpr std::int64_t clocks_for_results = 3000; // less than the loop back to P1.0 high needs

/// Two hexadecimal digits at `at`, if they are there.
std::optional<std::uint8_t> hex_byte(std::string_view line, std::size_t at) {
    unsigned value = 0;
    if (at + 2 > line.size()) {
        return std::nullopt;
    }
    const char* const begin = line.data() + at;
    const auto [end, fault] = std::from_chars(begin, begin + 2, value, 16);
    if (fault != std::errc{} || end != begin + 2) {
        return std::nullopt;
    }
    return static_cast<std::uint8_t>(value);
}

/// The bytes of a record, without the checksum, which must be right.
std::vector<std::uint8_t> record_of(std::string_view line, const Place& place) {
    const auto refuse = [&](const char* what) { throw Error(Diagnostic{place, what, {}}); };
    if (!line.starts_with(':')) {
        refuse("a record of Intel HEX must start with a colon");
    }
    std::vector<std::uint8_t> bytes;
    unsigned sum = 0;
    for (std::size_t at = 1; at < line.size(); at += 2) {
        const auto byte = hex_byte(line, at);
        if (!byte) {
            refuse("a record of Intel HEX must have two hexadecimal digits per byte");
        }
        bytes.push_back(*byte);
        sum += *byte;
    }
    constexpr std::size_t frame = 5; // length, address, kind, checksum
    if (bytes.size() < frame || bytes.size() != frame + bytes[0]) {
        refuse("the record length does not match its length byte");
    }
    if ((sum & 0xffU) != 0) {
        refuse("the checksum of the record is wrong");
    }
    bytes.pop_back();
    return bytes;
}

void put_word(std::vector<std::uint8_t>& memory, std::size_t at, std::uint32_t word) {
    for (int n = 0; n < 4; ++n) {
        memory[at + static_cast<std::size_t>(n)] = static_cast<std::uint8_t>(word >> (8 * n));
    }
}

float number_at(const std::vector<std::uint8_t>& memory, std::size_t at) {
    std::uint32_t word = 0;
    for (int n = 3; n >= 0; --n) {
        word = word << 8U | memory[at + static_cast<std::size_t>(n)];
    }
    return std::bit_cast<float>(word);
}

/// Executes until P1.0 is as wanted.
void run_to_pin(Mcs51& processor, bool high, const std::string& file) {
    while (processor.p1(0) != high) {
        if (processor.stop() != Mcs51Stop::none) {
            throw Error(
                fmt::format("the MCS-51 stopped at {:#06x}: {}", processor.pc(), to_text(processor.stop())),
                file);
        }
        if (processor.clocks() > most_mcs51_clocks) {
            throw Error(
                fmt::format("P1.0 did not go {} within {} clocks", high ? "high" : "low", most_mcs51_clocks),
                file,
                "change the program to hold P1.0 high while it computes, as line-8051.c does");
        }
        processor.step();
    }
}

} // namespace

std::vector<std::uint8_t> read_intel_hex(std::string_view text, const std::string& file) {
    std::vector<std::uint8_t> memory;
    int number = 0;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        const Place place{file, ++number, 1, -1};
        if (line.ends_with('\r')) {
            line.remove_suffix(1);
        }
        if (line.empty()) {
            continue;
        }
        const std::vector<std::uint8_t> record = record_of(line, place);
        constexpr std::size_t head = 4;
        const std::size_t address = static_cast<std::size_t>(record[1]) << 8U | record[2];
        if (record[3] == 1) {
            return memory;
        }
        if (record[3] != 0) {
            throw Error(Diagnostic{
                place,
                fmt::format("record type {:02x} is not supported: only 00 and 01 apply to an MCS-51",
                            record[3]),
                {}});
        }
        const std::size_t last = address + record[0];
        if (last > 0x10000) {
            throw Error(Diagnostic{place, "the data extend beyond address 0xffff", {}});
        }
        memory.resize(std::max(memory.size(), last));
        std::copy(record.begin() + head, record.end(), memory.begin() + static_cast<std::ptrdiff_t>(address));
    }
    throw Error(Diagnostic{{file, number, 1, -1}, "the file ends without its end record, :00000001FF", {}});
}

Mcs51LineRun
run_mcs51_line(const std::vector<std::uint8_t>& code, const Mcs51Line& line, const std::string& file) {
    Mcs51 processor(code);
    std::vector<std::uint8_t>& memory = processor.xdata();
    put_word(memory, 0x00, static_cast<std::uint32_t>(line.x0));
    put_word(memory, 0x04, static_cast<std::uint32_t>(line.x1));
    put_word(memory, 0x08, static_cast<std::uint32_t>(line.y0));
    put_word(memory, 0x0c, static_cast<std::uint32_t>(line.y1));
    put_word(memory, 0x10, std::bit_cast<std::uint32_t>(1.0F));
    put_word(memory, 0x14, std::bit_cast<std::uint32_t>(1.0F));
    run_to_pin(processor, false, file); // the pins are high after reset
    run_to_pin(processor, true, file);
    const std::int64_t begin = processor.clocks();
    run_to_pin(processor, false, file);
    Mcs51LineRun run{.clocks = processor.clocks() - begin};
    const std::int64_t end = processor.clocks() + clocks_for_results;
    while (processor.clocks() < end && processor.stop() == Mcs51Stop::none && !processor.p1(0)) {
        processor.step();
    }
    run.vx = static_cast<double>(number_at(memory, 0x18));
    run.vy = static_cast<double>(number_at(memory, 0x1c));
    run.ax = static_cast<double>(number_at(memory, 0x20));
    run.ay = static_cast<double>(number_at(memory, 0x24));
    run.sign_x = static_cast<std::int8_t>(memory[0x28]);
    run.sign_y = static_cast<std::int8_t>(memory[0x29]);
    return run;
}

} // namespace millwright::cordic
