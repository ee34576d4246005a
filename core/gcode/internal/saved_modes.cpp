#include "core/gcode/internal/saved_modes.h"

#include "core/base/numbers.h"
#include "core/base/text.h"
#include "core/gcode/internal/codes.h"
#include "core/gcode/internal/execute.h"
#include "core/gcode/internal/refusal.h"
#include "core/gcode/internal/variables.h"

#include <fmt/format.h>

#include <string>
#include <vector>

namespace millwright::gcode::internal {

namespace {

constexpr int feed_mode_code(FeedMode mode) {
    return mode == FeedMode::inverse_time ? 930 : mode == FeedMode::per_revolution ? 950 : 940;
}

constexpr int path_code(program::PathMode mode) {
    return mode == program::PathMode::exact_path ? 610 : mode == program::PathMode::exact_stop ? 611 : 640;
}

/// As LinuxCNC remembers it: not which offset.
constexpr int tool_length_code(const AxisValues& offset) {
    for (std::size_t n = 0; n < axis_count; ++n) {
        if (!exactly_equal(offset[n], 0.0)) {
            return 430;
        }
    }
    return 490;
}

constexpr int spindle_code(SpindleTurning turning) {
    return turning == SpindleTurning::clockwise ? 3 : turning == SpindleTurning::counterclockwise ? 4 : 5;
}

/// The codes of both states that differ, those of `saved`.
class Difference {
public:
    Difference(const ModalState& now, const ModalState& saved) : now_(now), saved_(saved) {}

    template <class CodeOf> void g(const CodeOf& code_of) {
        if (code_of(now_) != code_of(saved_)) {
            words_ += " " + g_name(code_of(saved_));
        }
    }
    [[nodiscard]] const std::string& words() const { return words_; }

private:
    const ModalState& now_;
    const ModalState& saved_;
    std::string words_;
};

std::string g_words(const ModalState& now, const ModalState& saved) {
    Difference difference(now, saved);
    difference.g([](const ModalState& s) { return plane_code(s.plane); });
    difference.g([](const ModalState& s) { return s.distance == DistanceMode::incremental ? 910 : 900; });
    difference.g([](const ModalState& s) { return feed_mode_code(s.feed_mode); });
    difference.g([](const ModalState& s) { return system_code(s.coordinate_system); });
    difference.g([](const ModalState& s) { return tool_length_code(s.tool_offset); });
    difference.g([](const ModalState& s) { return s.cycle_return == CycleReturn::r_level ? 990 : 980; });
    difference.g([](const ModalState& s) { return path_code(s.path_mode); });
    difference.g([](const ModalState& s) {
        return s.spindle_mode == SpindleMode::constant_surface_speed ? 960 : 970;
    });
    difference.g([](const ModalState& s) { return s.arc_distance == DistanceMode::absolute ? 901 : 911; });
    difference.g([](const ModalState& s) { return s.diameter_mode ? 70 : 80; });
    std::string words = difference.words();
    if (saved.path_mode == program::PathMode::continuous && now.path_mode != saved.path_mode) {
        words += " P" + shortest(saved.path_tolerance) + " Q" + shortest(saved.naivecam_tolerance);
    }
    if (now.cutter.on() && !saved.cutter.on()) {
        words += " G40";
    }
    return words;
}

std::string number_words(const ModalState& now, const ModalState& saved) {
    std::string words;
    const bool needs_speed =
        saved.spindle_mode == SpindleMode::constant_surface_speed && now.spindle_mode != saved.spindle_mode;
    if (!exactly_equal(now.feed_rate, saved.feed_rate) && saved.feed_mode != FeedMode::inverse_time) {
        words += " F" + shortest(saved.feed_rate);
    }
    if (needs_speed || !exactly_equal(now.spindle_speed, saved.spindle_speed)) {
        words += " S" + shortest(saved.spindle_speed);
    }
    return words;
}

/// In LinuxCNC's order.
std::vector<std::string> m_words(const ModalState& now, const ModalState& saved) {
    std::vector<std::string> words;
    if (now.spindle != saved.spindle) {
        words.push_back(fmt::format("M{}", spindle_code(saved.spindle)));
    }
    const bool all_off = (now.mist && !saved.mist) || (now.flood && !saved.flood);
    if (all_off) {
        words.emplace_back("M9");
    }
    if (saved.mist && (all_off || !now.mist)) {
        words.emplace_back("M7");
    }
    if (saved.flood && (all_off || !now.flood)) {
        words.emplace_back("M8");
    }
    const OverrideSwitches& was = saved.overrides;
    const OverrideSwitches& is = now.overrides;
    const bool same_overrides = is.feed == was.feed && is.speed == was.speed;
    if (!same_overrides && was.feed == was.speed) {
        words.emplace_back(was.feed ? "M48" : "M49");
    } else if (!same_overrides) {
        words.emplace_back(was.feed ? "M50 P1" : "M50 P0");
        words.emplace_back(was.speed ? "M51 P1" : "M51 P0");
    }
    if (is.adaptive_feed != was.adaptive_feed) {
        words.emplace_back(was.adaptive_feed ? "M52 P1" : "M52 P0");
    }
    if (is.feed_hold != was.feed_hold) {
        words.emplace_back(was.feed_hold ? "M53 P1" : "M53 P0");
    }
    return words;
}

bool g92_is_active(const Run& run) {
    return run.variables.stored(parameter_g92_active) > 0.0;
}

} // namespace

void execute_saved_modes(Run& run, const Block& block, int code) {
    if (code == 70 || code == 73) {
        run.saved = SavedModes{run.state, g92_is_active(run), code == 73};
    } else if (code == 71) {
        run.saved.reset();
    } else if (!run.saved) {
        refuse(block.column_of(MGroup::spindle), "M72 needs an M70 or M73 before it");
    } else {
        restore_modes(run, SavedModes(*run.saved));
    }
}

void restore_modes(Run& run, const SavedModes& modes) {
    const ModalState& saved = modes.state;
    if (run.state.unit != saved.unit) {
        execute_text(run, saved.unit == LengthUnit::mm ? "G21" : "G20");
    }
    const ModalState now = run.state;
    // LinuxCNC writes the first M-code into the line of the others, and a line to each further one.
    std::string line = number_words(now, saved) + g_words(now, saved);
    if (g92_is_active(run) != modes.g92_active) {
        line += modes.g92_active ? " G92.3" : " G92.2";
    }
    for (const std::string& word : m_words(now, saved)) {
        execute_text(run, line + " " + word);
        line.clear();
    }
    if (!line.empty()) {
        execute_text(run, line);
    }
}

} // namespace millwright::gcode::internal
