#include "core/cordic/vcd.h"

#include "core/cordic/assembler.h"

#include <gtest/gtest.h>

#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace millwright::cordic {
namespace {

struct Waves {
    std::map<std::string, std::map<std::int64_t, std::uint64_t>> changes; ///< name -> time -> value
    std::map<std::string, int> bits;

    /// The value of a signal at a time.
    [[nodiscard]] std::uint64_t at(const std::string& name, std::int64_t time) const {
        const auto& all = changes.at(name);
        auto after = all.upper_bound(time);
        EXPECT_NE(after, all.begin()) << name << " has no value at " << time;
        return (--after)->second;
    }
};

/// A reader of Value Change Dumps that knows nothing of the writer.
Waves read(const std::string& text) {
    Waves waves;
    std::map<std::string, std::string> names;
    std::istringstream in(text);
    std::string word;
    std::int64_t time = -1;
    while (in >> word) {
        if (word == "$var") {
            std::string kind, code, name;
            int bits = 0;
            in >> kind >> bits >> code >> name;
            names[code] = name;
            waves.bits[name] = bits;
            while (word != "$end") {
                in >> word;
            }
        } else if (word[0] == '$') {
            while (word != "$end") {
                in >> word;
            }
        } else if (word[0] == '#') {
            const std::int64_t next = std::stoll(word.substr(1));
            EXPECT_GT(next, time);
            time = next;
        } else if (word[0] == 'b') {
            std::string code;
            in >> code;
            EXPECT_LE(static_cast<int>(word.size()) - 1, waves.bits.at(names.at(code)));
            waves.changes[names.at(code)][time] = std::stoull(word.substr(1), nullptr, 2);
        } else {
            waves.changes[names.at(word.substr(1))][time] = word[0] == '1' ? 1 : 0;
        }
    }
    return waves;
}

TEST(Vcd, SaysTheSameAsTheStatesItWasMadeFrom) {
    const auto [image, lines, errors] = assemble("mov Vmax, 0.5\nmov XI, 6\nmov YJ, 8\ng01\nhlt", "a.asm");
    ASSERT_TRUE(errors.empty());
    Processor processor({.publishing = Publishing::bus, .wait_states = 1}, image);
    VcdWriter writer(image.format, 8e6);
    std::vector<ProcessorState> states;
    while (processor.state().stop == Stop::none) {
        processor.clock();
        states.push_back(processor.state());
        writer.add(processor.state());
    }
    const Waves waves = read(writer.take());
    constexpr std::int64_t period = 125'000; // ps at 8 MHz
    for (std::size_t n = 0; n < states.size(); ++n) {
        const auto time = static_cast<std::int64_t>(n) * period;
        EXPECT_EQ(waves.at("clk", time), 1U);
        EXPECT_EQ(waves.at("clk", time + period / 2), 0U);
        EXPECT_EQ(waves.at("ALE", time), states[n].bus.pins.ale ? 1U : 0U);
        EXPECT_EQ(waves.at("PSEN_n", time), states[n].bus.pins.psen ? 0U : 1U);
        EXPECT_EQ(waves.at("WR_n", time), states[n].bus.pins.wr ? 0U : 1U);
        EXPECT_EQ(waves.at("RD_n", time), 1U);
        EXPECT_EQ(waves.at("A", time), states[n].bus.pins.address);
        EXPECT_EQ(waves.at("AD", time), states[n].bus.pins.data);
        EXPECT_EQ(waves.at("x", time), states[n].path.x);
        EXPECT_EQ(waves.at("Vx", time), states[n].registers[static_cast<std::size_t>(Register::Vx)]);
        EXPECT_EQ(waves.at("PC", time), states[n].registers[static_cast<std::size_t>(Register::PC)]);
    }
    EXPECT_EQ(waves.at("running", static_cast<std::int64_t>(states.size()) * period), 0U);
}

} // namespace
} // namespace millwright::cordic
