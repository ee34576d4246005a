#include "core/drivers/grbl/internal/position_doubt.h"

#include "core/base/numbers.h"
#include "core/drivers/grbl/internal/words.h"

#include <algorithm>
#include <utility>

namespace millwright::drivers::grbl {

void PositionDoubt::arise(std::string why, bool lost) {
    why_ = std::move(why);
    lost_ = lost;
    zeroed_.clear();
    confirmed_.clear();
    homed_ = false;
}

void PositionDoubt::end() {
    const bool homed = homed_;
    *this = {};
    homed_ = homed;
}

void PositionDoubt::confirm() {
    std::string why = why_.empty() ? confirmed_ : why_;
    end();
    confirmed_ = std::move(why);
}

void PositionDoubt::zeroed(std::string_view axes, std::string_view machine_axes) {
    zeroed_ += axes;
    const auto has_zero = [this](char axis) { return zeroed_.find(axis) != std::string::npos; };
    if (std::ranges::all_of(machine_axes, has_zero)) {
        end();
    }
}

std::string axes_zeroed_by(std::string_view line, std::string_view machine_axes) {
    const auto words = words_of(line);
    if (!words) {
        return {};
    }
    const auto says = [&words](char letter, double value) {
        return std::ranges::any_of(*words, [=](const Word& word) {
            return word.letter == letter && exactly_equal(word.value, value);
        });
    };
    constexpr double set_offset = 92.0;
    constexpr double set_data = 10.0;
    constexpr double from_here = 20.0;
    std::string axes;
    if (says('G', set_offset) || (says('G', set_data) && says('L', from_here))) {
        for (const Word& word : *words) {
            axes.append(machine_axes.find(word.letter) == std::string_view::npos ? 0 : 1, word.letter);
        }
    }
    return axes;
}

} // namespace millwright::drivers::grbl
