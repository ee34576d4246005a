#include "tests/core/gcode/random_program.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <random>
#include <string_view>

namespace millwright::test {

namespace {

/// The letters of a plane: its axes, the one across, the centre's words.
struct PlaneLetters {
    std::string_view code;
    char first, second, third, centre_1, centre_2;
};

constexpr std::array<PlaneLetters, 3> planes{
    {{"G17", 'X', 'Y', 'Z', 'I', 'J'}, {"G18", 'Z', 'X', 'Y', 'K', 'I'}, {"G19", 'Y', 'Z', 'X', 'J', 'K'}}};

class Writer {
public:
    explicit Writer(unsigned seed) : random_(seed) {}

    double number(double from, double to) {
        const double value = std::uniform_real_distribution<double>(from, to)(random_);
        return std::round(value * 1e4) / 1e4;
    }
    int whole(int from, int to) { return std::uniform_int_distribution<int>(from, to)(random_); }
    bool chance(double of) { return number(0.0, 1.0) < of; }
    template <std::size_t N> std::string_view one_of(const std::array<std::string_view, N>& texts) {
        return texts[static_cast<std::size_t>(whole(0, static_cast<int>(N) - 1))];
    }

    template <class... Values> void line(fmt::format_string<Values...> text, Values&&... values) {
        text_ += fmt::format(text, std::forward<Values>(values)...);
        text_ += '\n';
    }
    std::string word(char letter, double from, double to) {
        return fmt::format("{}{:.4f} ", letter, number(from, to));
    }
    std::string words(std::string_view letters, double chance_of_each, double size) {
        std::string text;
        for (const char letter : letters) {
            if (chance(chance_of_each)) {
                text += word(letter, -size, size);
            }
        }
        return text;
    }
    [[nodiscard]] const std::string& text() const { return text_; }

    const PlaneLetters* plane = &planes[0]; // NOLINT(misc-non-private-member-variables-in-classes)
    bool incremental = false;
    bool absolute_centres = false;
    int labels = 0;

    void distance_mode() { line("{}", incremental ? "G91" : "G90"); }

private:
    std::mt19937 random_;
    std::string text_;
};

void straight(Writer& w) {
    w.line("{} {}", w.chance(0.4) ? "G0" : "G1", w.words("XYZABC", 0.5, 20.0));
}

void full_circle(Writer& w) {
    const PlaneLetters& p = *w.plane;
    std::string text = w.word(p.centre_1, -9.0, 9.0) + w.word(p.centre_2, 1.0, 9.0);
    text += w.chance(0.5) ? w.word(p.third, -9.0, 9.0) : "";
    text += w.chance(0.4) ? fmt::format("P{} ", w.whole(1, 4)) : "";
    text += w.chance(0.3) ? w.word('A', -90.0, 90.0) : "";
    w.line("{} {}", w.chance(0.5) ? "G2" : "G3", text);
}

void radius_arc(Writer& w) {
    const PlaneLetters& p = *w.plane;
    const double first = w.number(-5.0, 5.0);
    const double second = w.number(0.5, 5.0);
    const double radius = 0.5 * std::hypot(first, second) * w.number(1.01, 3.0);
    w.line("G91");
    w.line("{} {}{:.4f} {}{:.4f} R{}{:.4f}",
           w.chance(0.5) ? "G2" : "G3",
           p.first,
           first,
           p.second,
           second,
           w.chance(0.5) ? "-" : "",
           radius);
    w.distance_mode();
}

void arc(Writer& w) {
    if (w.chance(0.5) && !w.absolute_centres) {
        full_circle(w);
    } else {
        radius_arc(w);
    }
}

void select_plane(Writer& w) {
    w.plane = &planes[static_cast<std::size_t>(w.whole(0, 2))];
    w.line("{}", w.plane->code);
}

void change_distance(Writer& w) {
    w.incremental = !w.incremental;
    w.distance_mode();
}

void change_centres(Writer& w) {
    w.absolute_centres = !w.absolute_centres;
    w.line("{}", w.absolute_centres ? "G90.1" : "G91.1");
}

void select_system(Writer& w) {
    w.line("{}", w.one_of(std::array<std::string_view, 5>{"G54", "G55", "G56", "G59.1", "G59.3"}));
}

void set_system(Writer& w) {
    const bool relative = w.chance(0.5);
    w.line("G10 L{} P{} {}{}",
           relative ? 20 : 2,
           w.whole(0, 9),
           w.words("XYZABC", 0.4, 9.0),
           !relative && w.chance(0.3) ? w.word('R', -90.0, 90.0) : "");
}

void axis_offset(Writer& w) {
    if (w.chance(0.5)) {
        w.line("{}", w.one_of(std::array<std::string_view, 3>{"G92.1", "G92.2", "G92.3"}));
    } else {
        w.line("{} {} {}", w.chance(0.5) ? "G92" : "G52", w.word('X', -9.0, 9.0), w.words("YZA", 0.5, 9.0));
    }
}

void reference(Writer& w) {
    w.line("{} {}",
           w.one_of(std::array<std::string_view, 2>{"G28", "G30"}),
           w.chance(0.5) ? w.words("XYZ", 0.5, 5.0) : "");
    w.line("{}", w.one_of(std::array<std::string_view, 2>{"G28.1", "G30.1"}));
}

/// rs274 takes the position behind a tool change from a machine without tool lengths: every axis moves then.
void tool(Writer& w) {
    w.line("{}",
           w.one_of(std::array<std::string_view, 8>{
               "T1 M6", "T2 M6", "T99 M6", "G43", "G43 H2", "G43.1 Z-2.5 X1", "G49", "G43.2 H1"}));
    w.line("G90 G0 {}{}{}A1 B2 C3", w.word('X', -5, 5), w.word('Y', -5, 5), w.word('Z', -5, 5));
    w.distance_mode();
}

void cycle(Writer& w) {
    constexpr std::array<std::string_view, 12> cycles{"G81",
                                                      "G82 P0.5",
                                                      "G83 Q0.8",
                                                      "G83 Q2.5",
                                                      "G73 Q0.9",
                                                      "G85",
                                                      "G86 P1",
                                                      "G89 P0.5",
                                                      "G87 I1 J-0.5 K0.7",
                                                      "G88 P0.2",
                                                      "G81",
                                                      "G73 Q3"};
    const PlaneLetters& p = *w.plane;
    w.line("G90 M3 {}", w.chance(0.5) ? "G98" : "G99");
    const double bottom = w.number(-5.0, 0.0);
    w.line("{} {}{}{}{:.4f} R{:.4f} {}",
           w.one_of(cycles),
           w.word(p.first, -9, 9),
           w.word(p.second, -9, 9),
           p.third,
           bottom,
           bottom + w.number(1.0, 6.0),
           w.chance(0.3) ? "L2" : "");
    for (int n = w.whole(0, 3); n > 0; --n) {
        w.line("{}{}", w.word(p.first, -9, 9), w.word(p.second, -9, 9));
    }
    if (w.chance(0.4)) {
        w.line("G91 G81 {}{}-{:.4f} R{:.4f} L{}",
               w.word(p.first, -3, 3),
               p.third,
               w.number(1, 4),
               w.number(0.1, 2),
               w.whole(1, 3));
    }
    w.line("G80");
    w.distance_mode();
}

void expression(Writer& w) {
    constexpr std::array<std::string_view, 11> operators{
        "+", "-", "*", "/", "**2+", "MOD", "EQ", "LT", "AND", "OR", "XOR"};
    w.line("#{}=[{:.4f} {} {:.4f}]", w.whole(1, 30), w.number(-9, 9), w.one_of(operators), w.number(1, 9));
    w.line("G1 X[#{}] Y[SIN[#{}*10]*3] Z[ATAN[#{}]/[2]]", w.whole(1, 30), w.whole(1, 30), w.whole(1, 30));
}

void inverse_time(Writer& w) {
    w.line("G93");
    w.line("G1 {}F{:.4f}", w.word('X', -9, 9), w.number(1, 9));
    w.line("G1 {}F{:.4f}", w.word('A', -90, 90), w.number(1, 9));
    w.line("G94 F{:.4f}", w.number(10, 90));
}

void loop(Writer& w) {
    const int label = ++w.labels;
    w.line("O{} repeat [{}]", label, w.whole(0, 4));
    w.line("G91 G1 {}{}", w.word('X', -2, 2), w.word('Y', -2, 2));
    w.line("O{} if [#<_x> GT {:.4f}]", label + 1000, w.number(-9, 9));
    w.line("G1 {}", w.word('Z', -1, 1));
    w.line("O{} else", label + 1000);
    w.line("G1 Z0.5");
    w.line("O{} endif", label + 1000);
    w.line("O{} endrepeat", label);
    w.distance_mode();
}

void setting(Writer& w) {
    constexpr std::array<std::string_view, 22> settings{"G61",
                                                        "G61.1",
                                                        "G64",
                                                        "G64 P0.05",
                                                        "G64 P0.1 Q0.02",
                                                        "M8",
                                                        "M9",
                                                        "M7",
                                                        "M5",
                                                        "M4",
                                                        "S450",
                                                        "G4 P0.5",
                                                        "M48",
                                                        "M49",
                                                        "(say)",
                                                        "G97 S500",
                                                        "G96 S100 D300",
                                                        "(debug, #1 #5221 #<_x> #<_feed_hold>)",
                                                        "M19 R30 P1",
                                                        "(msg, hello)",
                                                        "M52 P1",
                                                        "M0"};
    w.line("{}", w.one_of(settings));
    w.line("M3");
}

void machine_coordinates(Writer& w) {
    if (!w.incremental) {
        w.line("G53 G0 {}{}", w.word('X', -9, 9), w.words("YZB", 0.5, 9.0));
    }
}

} // namespace

std::string random_program_text(unsigned seed) {
    using Make = void (*)(Writer&);
    constexpr std::array<Make, 24> makers{straight,
                                          straight,
                                          straight,
                                          straight,
                                          straight,
                                          arc,
                                          arc,
                                          arc,
                                          select_plane,
                                          change_distance,
                                          change_centres,
                                          select_system,
                                          set_system,
                                          axis_offset,
                                          reference,
                                          tool,
                                          cycle,
                                          cycle,
                                          expression,
                                          inverse_time,
                                          loop,
                                          setting,
                                          setting,
                                          machine_coordinates};
    Writer w(seed);
    w.line("{} G90 G17 G94 F{:.4f} S1000 M3", w.chance(0.3) ? "G20" : "G21", w.number(50, 500));
    w.line("G0 X1 Y1 Z1");
    for (int n = w.whole(20, 80); n > 0; --n) {
        makers[static_cast<std::size_t>(w.whole(0, static_cast<int>(makers.size()) - 1))](w);
    }
    w.line("M2");
    return w.text();
}

std::string random_contour(unsigned seed) {
    Writer w(seed);
    const PlaneLetters& p = planes[static_cast<std::size_t>(w.whole(0, 1))];
    double first = w.number(-50, 50);
    double second = w.number(-50, 50);
    w.line("G21 G90 {} G94 F100", p.code);
    w.line("G0 {}{:.4f} {}{:.4f}", p.first, first, p.second, second);
    w.line("{} D{:.4f}", w.chance(0.5) ? "G41.1" : "G42.1", w.number(0.5, 6.0));
    for (int n = 0, count = w.whole(3, 14); n < count; ++n) {
        if (n > 0 && w.chance(0.1)) {
            w.line("G1 {}", w.word(p.third, -5, 5));
            continue;
        }
        const double next_first = first + w.number(-30, 30);
        const double next_second = second + w.number(-30, 30);
        const std::string end = fmt::format("{}{:.4f} {}{:.4f}", p.first, next_first, p.second, next_second);
        if (n == 0 || w.chance(0.6)) {
            w.line("{} {}", w.chance(0.75) ? "G1" : "G0", end);
        } else {
            const double half = 0.5 * std::hypot(next_first - first, next_second - second);
            w.line("{} {} R{}{:.4f}",
                   w.chance(0.5) ? "G2" : "G3",
                   end,
                   w.chance(0.3) ? "-" : "",
                   half * w.number(1.05, 4.0));
        }
        first = next_first;
        second = next_second;
        if (w.chance(0.1)) {
            w.line("F{}", w.whole(10, 99));
        }
    }
    w.line("G40");
    w.line("G0 {}{:.4f}", p.first, first + 20.0);
    w.line("M2");
    return w.text();
}

} // namespace millwright::test
