#include "core/cordic_control/input_changes.h"

#include "core/base/text.h"
#include "core/cordic/line_words.h"

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <utility>

namespace millwright::cordic {
namespace {

constexpr PlcBit no_bit = -1;

PlcBit input_of(std::string_view name) {
    const PlcBit bit = plc_bit(name).value_or(no_bit);
    return bit != no_bit && plc_is_input(bit) ? bit : no_bit;
}

} // namespace

ReadInputs read_inputs(std::string_view text, const std::filesystem::path& name) {
    ReadInputs read;
    if (auto fault = wide_text_fault(text, name)) {
        read.errors.push_back(std::move(*fault));
        return read;
    }
    text = without_byte_order_mark(text);
    for (int line = 1; !text.empty(); ++line) {
        const std::vector<LineWord> words = words_of(take_line(text));
        const auto fail = [&](std::size_t at, std::string message) {
            const int column = at < words.size() ? words[at].column : words.back().column;
            read.errors.push_back({{name, line, column, -1}, std::move(message), "write SECONDS BIT 0 or 1"});
        };
        if (words.empty()) {
            continue;
        }
        InputChange change;
        const PlcBit bit = words.size() > 1 ? input_of(words[1].text) : no_bit;
        if (!read_real(words[0].text, change.seconds) || change.seconds < 0.0) {
            fail(0, fmt::format("\"{}\" is not a time in seconds", words[0].text));
        } else if (!read.changes.empty() && change.seconds < read.changes.back().seconds) {
            fail(0, fmt::format("{} is earlier than the line above", words[0].text));
        } else if (bit == no_bit) {
            fail(1, "an input, I0 to I31, is missing");
        } else if (words.size() != 3 || (words[2].text != "0" && words[2].text != "1")) {
            fail(2, "a 0 or 1 is missing");
        } else {
            change.bit = bit;
            change.value = words[2].text == "1";
            read.changes.push_back(change);
        }
    }
    return read;
}

} // namespace millwright::cordic
