// The I-variables of a PMAC: what they are from the factory, what they may be, how they are written.
#pragma once

#include <string>
#include <vector>

namespace millwright::pmac::card {

constexpr int variables_per_motor = 100; // Ixxnn: xx is the motor

class IVariables {
public:
    IVariables();

    [[nodiscard]] double value(int index) const { return values_[static_cast<std::size_t>(index)]; }
    /// Whole numbers of a limited range roll over instead of failing, as on the card.
    void set(int index, double value);
    void reset(int index) { set(index, factory(index)); }
    [[nodiscard]] static double factory(int index);
    /// An address, written with $ in the hexadecimal form.
    [[nodiscard]] static bool is_address(int index);

    [[nodiscard]] const std::vector<double>& values() const { return values_; }
    void load(const std::vector<double>& values) { values_ = values; }

private:
    std::vector<double> values_;
};

/// A number as the card writes it: at most nine decimals, none without need.
[[nodiscard]] std::string number_text(double value);
/// To a tenth.
[[nodiscard]] std::string tenths_text(double value);

} // namespace millwright::pmac::card
