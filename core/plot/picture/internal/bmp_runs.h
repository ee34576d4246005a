// The run-length codes of a BMP of 4 or 8 bits. Source: Microsoft, Windows GDI, bitmap compression.
#pragma once

#include "core/plot/picture/internal/row_sink.h"

#include <cstdint>
#include <span>
#include <string_view>

namespace millwright::plot::internal {

/// Reads rows from the lowest upward, as they are stored. Pixels that the codes jump over have index 0.
class BmpRuns {
public:
    /// `bytes` is the file, whose codes begin at byte `at`; `bits` is 4 or 8.
    BmpRuns(std::string_view bytes, std::int64_t at, int bits, RowSink& sink)
        : bytes_(bytes), at_(at), bits_(bits), sink_(sink) {}

    /// Fills `indices` with the next row up. Throws by the sink, with the byte, for codes that leave the row
    /// and where the file ends before the code that ends the picture.
    void next_row(std::span<unsigned char> indices);

private:
    enum class Escape : unsigned char { end_of_row = 0, end_of_picture = 1, jump = 2 };

    [[nodiscard]] unsigned char next_byte();
    /// The index of pixel `n` of a run or of literal pixels, in `pair` of two of 4 bits or one of 8.
    [[nodiscard]] unsigned char index_of(unsigned char pair, int n) const;
    void repeat(std::span<unsigned char> indices, int count);
    void copy(std::span<unsigned char> indices, int count);
    void jump(std::span<const unsigned char> indices);
    void check_room(std::span<const unsigned char> indices, int count) const;

    std::string_view bytes_;
    std::int64_t at_;
    int bits_;
    RowSink& sink_;
    std::int64_t code_at_ = 0; ///< byte of the code that is being obeyed
    std::int64_t x_ = 0;
    int rows_to_pass_ = 0; ///< that a jump left without a pixel
    bool ended_ = false;
};

} // namespace millwright::plot::internal
