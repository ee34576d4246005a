#include "core/plot/picture/internal/bmp_runs.h"

#include <fmt/format.h>

#include <algorithm>

namespace millwright::plot::internal {

void BmpRuns::next_row(std::span<unsigned char> indices) {
    std::ranges::fill(indices, static_cast<unsigned char>(0));
    if (ended_) {
        return;
    }
    if (rows_to_pass_ > 0 && --rows_to_pass_ > 0) {
        return;
    }
    for (bool row_ends = false; !row_ends;) {
        code_at_ = at_;
        const int count = next_byte();
        if (count > 0) {
            repeat(indices, count);
            continue;
        }
        const int what = next_byte();
        switch (static_cast<Escape>(what)) {
        case Escape::end_of_row:
            x_ = 0;
            row_ends = true;
            break;
        case Escape::end_of_picture:
            ended_ = true;
            row_ends = true;
            break;
        case Escape::jump:
            jump(indices);
            row_ends = rows_to_pass_ > 0;
            break;
        default:
            copy(indices, what);
        }
    }
}

unsigned char BmpRuns::next_byte() {
    if (at_ >= std::ssize(bytes_)) {
        sink_.fail(fmt::format("the BMP is cut off at byte {}, before the end code", bytes_.size()));
    }
    return static_cast<unsigned char>(bytes_[static_cast<std::size_t>(at_++)]);
}

unsigned char BmpRuns::index_of(unsigned char pair, int n) const {
    if (bits_ == 8) {
        return pair;
    }
    return n % 2 == 0 ? static_cast<unsigned char>(pair >> 4U) : static_cast<unsigned char>(pair & 15U);
}

void BmpRuns::repeat(std::span<unsigned char> indices, int count) {
    check_room(indices, count);
    const unsigned char pair = next_byte();
    for (int n = 0; n < count; ++n) {
        indices[static_cast<std::size_t>(x_++)] = index_of(pair, n);
    }
}

void BmpRuns::copy(std::span<unsigned char> indices, int count) {
    check_room(indices, count);
    const int in_byte = 8 / bits_;
    unsigned char pair = 0;
    for (int n = 0; n < count; ++n) {
        if (n % in_byte == 0) {
            pair = next_byte();
        }
        indices[static_cast<std::size_t>(x_++)] = index_of(pair, n);
    }
    const bool odd = (count + in_byte - 1) / in_byte % 2 != 0;
    if (odd) {
        (void)next_byte(); // literal pixels fill words of 16 bits
    }
}

void BmpRuns::jump(std::span<const unsigned char> indices) {
    const int right = next_byte();
    rows_to_pass_ = next_byte();
    check_room(indices, right);
    x_ += right;
}

void BmpRuns::check_room(std::span<const unsigned char> indices, int count) const {
    const auto width = std::ssize(indices);
    if (x_ + count > width) {
        sink_.fail(fmt::format("the run at byte {} of the BMP ends at column {}, beyond the width of {}",
                               code_at_,
                               x_ + count,
                               width));
    }
}

} // namespace millwright::plot::internal
