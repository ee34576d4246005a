// An emulated PMAC to talk to, line by line, in its own time.
#pragma once

#include "core/pmac/emulator/pmac_emulator.h"

#include <string>
#include <utility>

namespace millwright::test {

class PmacCard {
public:
    explicit PmacCard(pmac::PmacEmulatorOptions options = {}) : card(std::move(options)) {}

    pmac::PmacEmulator card;

    /// What it says to a line, as bytes.
    std::string raw(const std::string& line) {
        card.receive(line + "\r");
        return card.take_output();
    }
    /// Without the hand-shake of I3=1: the data, or "ERR003", or nothing.
    std::string ask(const std::string& line) { return bare(raw(line)); }
    std::string control(char character) {
        card.receive(std::string(1, character));
        return bare(card.take_output());
    }
    /// Every line of a text; the first refusal.
    std::string send(const std::string& text) {
        std::string line, refused;
        for (const char c : text + "\n") {
            if (c != '\n') {
                line += c;
            } else if (!line.empty()) {
                const std::string said = ask(std::exchange(line, {}));
                refused = refused.empty() && said.starts_with("ERR") ? said : refused;
            }
        }
        return refused;
    }

    /// Lets time pass in steps of a millisecond until `done`; how long that took, or -1.
    template <class Done> double wait_until(const Done& done, double longest = 100.0) {
        const double begin = card.time();
        while (card.time() - begin < longest) {
            card.advance(1e-3);
            if (done()) {
                return card.time() - begin;
            }
        }
        return -1.0;
    }
    /// Until all commanded motion has ended and the motors have settled.
    double settle(double longest = 100.0) {
        const double time = wait_until([this] { return !card.moving(); }, longest);
        card.advance(0.3);
        return time;
    }

private:
    static std::string bare(const std::string& bytes) {
        std::string text;
        for (const char c : bytes) {
            const bool line_end = c == '\r';
            text += c >= ' ' ? std::string(1, c) : line_end && !text.empty() && text.back() != '|' ? "|" : "";
        }
        while (text.ends_with('|')) {
            text.pop_back();
        }
        return text;
    }
};

/// The axes of the thesis: 120, 222, 150 and 150 counts a degree, motors active, gains as they come.
inline const std::string arm_axes = "I100=1\nI200=1\nI300=1\nI400=1\n"
                                    "#1->120X\n#2->222Y\n#3->150Z\n#4->150A\n#1J/\n#2J/\n#3J/\n#4J/\n";
/// Its motion program 1.
inline const std::string arm_program = "OPEN PROG 1\nCLEAR\nINC\nTA20\nTS10\nLINEAR\nFRAX(X,Y,Z,A)\n"
                                       "X10 Y10 Z10 A10 F0.5\nCLOSE\n";

} // namespace millwright::test
