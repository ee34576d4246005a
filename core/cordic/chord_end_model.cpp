#include "core/cordic/chord_end_model.h"

#include "core/cordic/angles.h"
#include "core/cordic/internal/arithmetic_unit.h"
#include "core/cordic/interpolation.h"

#include <type_traits>

namespace millwright::cordic {

ChordEndModel::ChordEndModel(const NumberFormat& format, const ProcessorSettings& settings)
    : kernel_(any_kernel(with_rounding(format, settings.rounding), settings.sequence, settings.zero)) {}

std::optional<PlaceWords> ChordEndModel::next(const ArcWords& arc, const PlaceWords& from) const {
    return std::visit(
        [&](const auto& kernel) -> std::optional<PlaceWords> {
            const auto& arithmetic = kernel.arithmetic();
            const auto number = [&](Word word) { return arithmetic.from_word(word); };
            const auto dz = number(arc.dz);
            if (kernel.reach_of_rotation(dz) != Reach::inside) {
                return std::nullopt;
            }
            bool overflow = false;
            const auto turn = arc.clockwise ? arithmetic.negated(dz, overflow) : dz;
            const auto end = arc_point(
                kernel, number(arc.i), number(arc.j), number(from.x), number(from.y), turn, overflow);
            const auto z = arithmetic.sum(number(from.z), number(arc.rise), overflow);
            if (overflow) {
                return std::nullopt;
            }
            return PlaceWords{arithmetic.to_word(end.x), arithmetic.to_word(end.y), arithmetic.to_word(z)};
        },
        kernel_);
}

bool ChordEndModel::reaches(const PlaceWords& from, const PlaceWords& to) const {
    ProcessorState state;
    register_of(state, Register::X0) = from.x;
    register_of(state, Register::Y0) = from.y;
    register_of(state, Register::Z0) = from.z;
    state.path.xe = to.x;
    state.path.ye = to.y;
    state.path.ze = to.z;
    std::visit(
        [&](const auto& kernel) {
            const auto& arithmetic = kernel.arithmetic();
            bool overflow = false; // is another reason, which the processor tells
            internal::fold_space(kernel, state, overflow);
            const auto plane = kernel.vectored({arithmetic.from_word(state.path.x),
                                                arithmetic.from_word(state.path.y),
                                                arithmetic.from_word(state.path.z)},
                                               overflow);
            state.path.x = arithmetic.to_word(plane.x);
            if (from.z != to.z) {
                internal::fold_rise(kernel, state);
            }
        },
        kernel_);
    return state.stop != Stop::out_of_reach;
}

double ChordEndModel::turned(Word dz) const {
    return std::visit(
        [&](const auto& kernel) {
            const Sequence& sequence = kernel.sequence();
            using Number = typename std::decay_t<decltype(kernel)>::Number;
            Vector3<Number> v{.z = kernel.arithmetic().from_word(dz)};
            bool overflow = false;
            double turned = 0.0;
            for (int i = 0; i < sequence.step_count; ++i) {
                const int sigma = kernel.direction(Mode::rotation, v);
                const int shift = sequence.shifts[static_cast<std::size_t>(i)];
                turned += sigma * to_floating<double>(wide_angle(sequence.m, shift));
                kernel.step(v, i, sigma, overflow);
            }
            return turned;
        },
        kernel_);
}

double ChordEndModel::number(Word word) const {
    return std::visit(
        [&](const auto& kernel) {
            return kernel.arithmetic().to_double(kernel.arithmetic().from_word(word));
        },
        kernel_);
}

} // namespace millwright::cordic
