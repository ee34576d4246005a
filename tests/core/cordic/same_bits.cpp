// Prints a checksum over the result bits of every kind of iteration. Built several times, at different
// optimisation levels and by different compilers; same_bits_test compares what they print. Links nothing of
// ours: code of two optimisation levels in one program would be merged into one.
#include "core/cordic/cordic.h"

#include <cstdint>
#include <cstdio>

namespace millwright::cordic {
namespace {

struct Digest {
    std::uint64_t hash = 0xcbf29ce484222325U; // FNV-1a

    void add(Word word) {
        for (int byte = 0; byte < 8; ++byte) {
            hash = (hash ^ ((word >> (8 * byte)) & 0xffU)) * 0x100000001b3U;
        }
    }
};

/// xorshift64: numbers between -1 and 1 without a library.
struct Random {
    std::uint64_t state = 88172645463325252U;

    double next() {
        state ^= state << 13U;
        state ^= state >> 7U;
        state ^= state << 17U;
        return static_cast<double>(static_cast<std::int64_t>(state) >> 11) * 0x1p-52;
    }
};

template <class Arithmetic>
void add_results(Digest& digest, const Arithmetic& arithmetic, const Sequence& sequence) {
    const Kernel<Arithmetic> kernel(arithmetic, sequence);
    Random random;
    for (int n = 0; n < 300; ++n) {
        bool overflow = false;
        const auto number = [&](double scale) {
            return arithmetic.from_double(scale * random.next(), overflow);
        };
        const auto x = number(1.0);
        const auto y = number(1.0);
        const auto z = number(1.5);
        const auto add = [&](const auto& v) {
            digest.add(arithmetic.to_word(v.x));
            digest.add(arithmetic.to_word(v.y));
        };
        add(kernel.rotated({x, y, z}, overflow));
        add(kernel.vectored({x, y, z}, overflow));
        const auto set = line_set_point(kernel, x, y, z, x, y, z, overflow);
        digest.add(arithmetic.to_word(set.vx));
        digest.add(arithmetic.to_word(set.ay));
        add(arc_point(kernel, x, y, z, x, y, overflow));
        digest.add(arithmetic.to_word(reduced(arithmetic, z).rest));
        digest.add(overflow ? 1U : 0U);
    }
}

void add_format(Digest& digest, const NumberFormat& format) {
    with_arithmetic(format, [&](const auto& arithmetic) {
        for (const auto m :
             {CoordinateSystem::circular, CoordinateSystem::linear, CoordinateSystem::hyperbolic}) {
            add_results(digest, arithmetic, thesis_sequence(m));
            add_results(digest, arithmetic, classic_sequence(m, 24));
        }
    });
}

int main() {
    Digest digest;
    add_format(digest, binary64);
    add_format(digest, binary32);
    for (const Rounding rounding :
         {Rounding::truncate, Rounding::toward_zero, Rounding::nearest, Rounding::nearest_even}) {
        add_format(digest, {NumberKind::fixed, 2, 14, rounding});
        add_format(digest, {NumberKind::fixed, 4, 28, rounding});
        add_format(digest, {NumberKind::fixed, 2, 62, rounding});
    }
    std::printf("%016llx\n", static_cast<unsigned long long>(digest.hash));
    return 0;
}

} // namespace
} // namespace millwright::cordic

int main() {
    return millwright::cordic::main();
}
