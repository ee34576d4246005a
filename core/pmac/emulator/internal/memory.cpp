#include "core/pmac/emulator/internal/memory.h"

#include "core/base/error.h"

#include <algorithm>
#include <cmath>

namespace millwright::pmac::card {

namespace {

constexpr int word_bits = 24;
constexpr int half_bits = 16;

std::size_t side_of(char side) {
    return side == 'X' ? 0 : 1;
}

double sign_extended(std::int64_t value, int bits) {
    const std::int64_t half = std::int64_t{1} << (bits - 1);
    return static_cast<double>(value >= half ? value - 2 * half : value);
}

std::int64_t nearest_integer(double value) {
    constexpr double most = 9e15;
    return std::llround(std::clamp(value, -most, most));
}

} // namespace

std::optional<Pointer> take_pointer(Words& words) {
    Pointer pointer;
    if (words.take("*")) {
        return pointer;
    }
    pointer.kind = words.at("X")    ? Pointer::Kind::x
                   : words.at("Y")  ? Pointer::Kind::y
                   : words.at("D")  ? Pointer::Kind::both
                   : words.at("DP") ? Pointer::Kind::dual_ported
                                    : Pointer::Kind::none;
    if (pointer.kind == Pointer::Kind::none) {
        return std::nullopt;
    }
    pointer.text = words.now().text + ":";
    words.skip();
    (void)words.take(":");
    const std::string address = words.now().text;
    const auto read = words.take_index(greatest_address);
    if (!read) {
        return std::nullopt;
    }
    pointer.address = *read;
    pointer.text += address;
    for (int part = 0; words.take(","); ++part) {
        pointer.text += "," + words.now().text;
        if (part == 2 && (words.take("S") || words.take("U"))) {
            pointer.is_signed = pointer.text.back() == 'S';
            return pointer;
        }
        const auto number = words.take_index(word_bits);
        if (!number || part > 1) {
            return std::nullopt;
        }
        (part == 0 ? pointer.bit : pointer.width) = *number;
        pointer.width = part == 0 ? 1 : pointer.width;
    }
    pointer.width = pointer.width == 0 ? word_bits : pointer.width;
    const bool fits = pointer.bit + pointer.width <= word_bits;
    return fits ? std::optional(pointer) : std::nullopt;
}

std::uint32_t MemoryMap::word(char side, int address) const {
    if (const auto value = registers_->read(side, address)) {
        return *value;
    }
    const auto found = words_.find(address);
    return found == words_.end() ? 0 : found->second[side_of(side)];
}

void MemoryMap::set_word(char side, int address, std::uint32_t value) {
    if (!registers_->write(side, address, value & word_mask)) {
        words_[address][side_of(side)] = value & word_mask;
    }
}

double MemoryMap::value(int index) const {
    const Pointer& at = pointer(index);
    switch (at.kind) {
    case Pointer::Kind::none:
        return own_[static_cast<std::size_t>(index)];
    case Pointer::Kind::both:
        return sign_extended((static_cast<std::int64_t>(word('X', at.address)) << word_bits) |
                                 word('Y', at.address),
                             2 * word_bits);
    case Pointer::Kind::dual_ported:
        return sign_extended((static_cast<std::int64_t>(word('X', at.address) & 0xFFFF) << half_bits) |
                                 (word('Y', at.address) & 0xFFFF),
                             2 * half_bits);
    default: {
        const std::uint32_t all = word(at.kind == Pointer::Kind::x ? 'X' : 'Y', at.address);
        const std::uint32_t part = (all >> at.bit) & ((1U << at.width) - 1U);
        return at.is_signed ? sign_extended(part, at.width) : part;
    }
    }
}

void MemoryMap::set_value(int index, double value) {
    const Pointer& at = pointer(index);
    const std::int64_t number = nearest_integer(value);
    switch (at.kind) {
    case Pointer::Kind::none:
        own_[static_cast<std::size_t>(index)] = value;
        break;
    case Pointer::Kind::both:
        set_word('X', at.address, static_cast<std::uint32_t>(number >> word_bits));
        set_word('Y', at.address, static_cast<std::uint32_t>(number));
        break;
    case Pointer::Kind::dual_ported:
        set_word('X', at.address, static_cast<std::uint32_t>(number >> half_bits) & 0xFFFF);
        set_word('Y', at.address, static_cast<std::uint32_t>(number) & 0xFFFF);
        break;
    default: {
        const char side = at.kind == Pointer::Kind::x ? 'X' : 'Y';
        const std::uint32_t mask = ((1U << at.width) - 1U) << at.bit;
        const std::uint32_t part = (static_cast<std::uint32_t>(number) << at.bit) & mask;
        set_word(side, at.address, (word(side, at.address) & ~mask) | part);
    }
    }
}

std::uint16_t MemoryMap::host_16(int offset) const {
    expects(offset >= 0 && offset % 2 == 0 && offset / 4 < dual_ported_end - dual_ported_begin,
            "the host reads inside the dual-ported RAM");
    return static_cast<std::uint16_t>(word(offset % 4 == 0 ? 'Y' : 'X', dual_ported_begin + offset / 4));
}

void MemoryMap::set_host_16(int offset, std::uint16_t value) {
    expects(offset >= 0 && offset % 2 == 0 && offset / 4 < dual_ported_end - dual_ported_begin,
            "the host writes inside the dual-ported RAM");
    set_word(offset % 4 == 0 ? 'Y' : 'X', dual_ported_begin + offset / 4, value);
}

std::int32_t MemoryMap::host_32(int offset) const {
    return static_cast<std::int32_t>((static_cast<std::uint32_t>(host_16(offset + 2)) << half_bits) |
                                     host_16(offset));
}

void MemoryMap::set_host_32(int offset, std::int32_t value) {
    const auto bits = static_cast<std::uint32_t>(value);
    set_host_16(offset, static_cast<std::uint16_t>(bits));
    set_host_16(offset + 2, static_cast<std::uint16_t>(bits >> half_bits));
}

} // namespace millwright::pmac::card
