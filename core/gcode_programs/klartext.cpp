#include "core/gcode_programs/klartext.h"

#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/gcode/program_text.h"
#include "core/gcode_programs/programmed_feed.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace millwright::gcode {

namespace {

constexpr double inch = 25.4;

struct Word {
    std::string_view text;
    int column = 1;
};

std::vector<Word> words_of(std::string_view line) {
    std::vector<Word> words;
    constexpr std::string_view blanks = " \t";
    for (std::size_t at = line.find_first_not_of(blanks); at != std::string_view::npos;) {
        const std::size_t end = std::min(line.find_first_of(blanks, at), line.size());
        words.push_back({line.substr(at, end - at), static_cast<int>(at) + 1});
        at = line.find_first_not_of(blanks, end);
    }
    return words;
}

/// A number with an optional sign, nothing behind it.
std::optional<double> number_in(std::string_view text) {
    if (text.starts_with('+')) {
        text.remove_prefix(1);
        if (text.starts_with('-')) {
            return std::nullopt;
        }
    }
    double value = 0.0;
    const auto read =
        std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
    const bool whole = read.ec == std::errc{} && read.ptr == text.data() + text.size();
    return whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

class Reader {
public:
    Reader(const std::filesystem::path& file, const WrittenTextRules& rules)
        : file_(file), rules_(rules), at_(rules.start) {}

    void read(std::string_view text) {
        while (!text.empty()) {
            ++line_;
            const std::string_view line = text.substr(0, end_of_line(text));
            block(line.substr(0, line.find(';')));
            text.remove_prefix(next_line(text, 0));
        }
        if (!ended_) {
            refuse(1, "the program must end with END PGM");
        }
    }

    std::vector<WrittenStep> take() { return std::move(steps_); }

private:
    const std::filesystem::path& file_;
    const WrittenTextRules& rules_;
    std::vector<WrittenStep> steps_;
    std::vector<Word> words_; ///< of the block, without its number
    std::string_view unit_name_;
    std::string name_;
    AxisValues at_; ///< as WrittenStep::target
    double unit_ = 1.0;
    double feed_ = 0.0; ///< mm or degrees per minute
    double rpm_ = 0.0;
    double sense_ = 0.0;     ///< of the spindle: 1, -1, or 0 while it rests
    int new_speed_line_ = 0; ///< of a TOOL CALL that has changed the speed of a turning spindle; 0: none
    double tool_ = 0.0;      ///< number of the last that was called
    int line_ = 0;
    int number_ = -1; ///< of the last block
    bool numbered_ = true;
    bool tip_ = false;
    bool ended_ = false;

    [[noreturn]] void refuse(int column, std::string message) const {
        throw Error({{file_, line_, column, -1}, std::move(message), {}});
    }

    [[nodiscard]] int end_column() const {
        return words_.empty() ? 1 : words_.back().column + static_cast<int>(words_.back().text.size());
    }

    /// True if the block begins with the words of `text`.
    [[nodiscard]] bool begins(std::string_view text) const {
        const std::vector<Word> wanted = words_of(text);
        return words_.size() >= wanted.size() &&
               std::equal(wanted.begin(), wanted.end(), words_.begin(), [](const Word& a, const Word& b) {
                   return a.text == b.text;
               });
    }

    /// The words behind `text`, of which there are `count`.
    [[nodiscard]] std::vector<Word> behind(std::string_view text, std::size_t count) const {
        const std::size_t head = words_of(text).size();
        if (words_.size() != head + count) {
            refuse(end_column(), fmt::format("{} must be followed by {}", text, counted(count, "word")));
        }
        return {words_.begin() + static_cast<std::ptrdiff_t>(head), words_.end()};
    }

    [[nodiscard]] double value_of(const Word& word, std::string_view prefix) const {
        if (!word.text.starts_with(prefix)) {
            refuse(word.column, fmt::format("'{}' is found where {} is expected", word.text, prefix));
        }
        const std::optional<double> value = number_in(word.text.substr(prefix.size()));
        if (!value) {
            refuse(word.column, fmt::format("'{}' is not a number", word.text));
        }
        return *value;
    }

    WrittenStep& add(StepKind kind) {
        const int speed_line = std::exchange(new_speed_line_, 0);
        const bool says_it =
            kind == StepKind::spindle_on || kind == StepKind::spindle_off || kind == StepKind::end;
        if (speed_line > 0 && !says_it) {
            WrittenStep& faster = steps_.emplace_back();
            faster.kind = StepKind::spindle_on;
            faster.line = speed_line;
            faster.value = sense_ * rpm_;
        }
        WrittenStep& step = steps_.emplace_back();
        step.kind = kind;
        step.line = line_;
        return step;
    }

    // ---- blocks

    void block(std::string_view line) {
        words_ = words_of(line);
        if (number_ < 0 && !words_.empty()) {
            numbered_ = number_in(words_.front().text).has_value();
        }
        if (words_.empty() && !numbered_) {
            return;
        }
        if (words_.empty()) {
            refuse(1, "the line is empty");
        }
        if (ended_) {
            refuse(1, "nothing may follow END PGM");
        }
        take_number();
        if (number_ == 0) {
            return begin_program();
        }
        // A comment, a heading, the blank of the graphics.
        if (words_.empty() || words_.front().text.starts_with('*') || begins("BLK FORM")) {
            return;
        }
        if (words_.front().text == "L") {
            return straight();
        }
        if (begins("END PGM")) {
            return end_program();
        }
        if (begins("TOOL CALL")) {
            return tool_call();
        }
        if (begins("CYCL DEF")) {
            return cycle();
        }
        if (begins("FUNCTION")) {
            return function();
        }
        for (const Word& word : words_) {
            miscellaneous(word);
        }
    }

    /// Blocks count from 0 without a gap, so that none is lost; or none has a number, as in files of some
    /// programs.
    void take_number() {
        if (!numbered_) {
            ++number_;
            return;
        }
        const Word first = words_.front();
        const std::optional<double> number = number_in(first.text);
        if (!number || !exactly_equal(*number, number_ + 1)) {
            refuse(first.column, fmt::format("the block number must be {}", number_ + 1));
        }
        ++number_;
        words_.erase(words_.begin());
    }

    void begin_program() {
        if (!begins("BEGIN PGM")) {
            refuse(1, "a program must start with BEGIN PGM");
        }
        const std::vector<Word> rest = behind("BEGIN PGM", 2);
        name_ = rest[0].text;
        if (rest[1].text != "MM" && rest[1].text != "INCH") {
            refuse(rest[1].column, "the unit must be MM or INCH");
        }
        unit_name_ = rest[1].text;
        unit_ = unit_name_ == "MM" ? 1.0 : inch;
    }

    void end_program() {
        const std::vector<Word> rest = behind("END PGM", 2);
        if (rest[0].text != name_ || rest[1].text != unit_name_) {
            refuse(rest[0].column, "the program name after END PGM differs from the one after BEGIN PGM");
        }
        ended_ = true;
    }

    void tool_call() {
        const auto number = words_.size() > 2 ? number_in(words_[2].text) : std::nullopt;
        if (number && !exactly_equal(*number, std::exchange(tool_, *number))) {
            add(StepKind::tool).value = *number;
        }
        for (const Word& word : words_) {
            if (word.text.starts_with('S')) {
                const double before = std::exchange(rpm_, value_of(word, "S"));
                if (!exactly_equal(sense_, 0.0) && !exactly_equal(before, rpm_)) {
                    new_speed_line_ = line_;
                }
            } else if (word.text.starts_with('F')) {
                feed_ = value_of(word, "F") * unit_;
            }
        }
    }

    void cycle() {
        if (begins("CYCL DEF 9.1 DWELL")) {
            add(StepKind::dwell).value = value_of(behind("CYCL DEF 9.1 DWELL", 1)[0], "");
        } else if (begins("CYCL DEF 32.1")) {
            (void)value_of(behind("CYCL DEF 32.1", 1)[0], "T");
        } else if (!begins("CYCL DEF 9.0") && !begins("CYCL DEF 32.0")) {
            refuse(words_.front().column, "only the cycles 9 and 32 are supported");
        }
    }

    void function() {
        if (begins("FUNCTION RESET TCPM")) {
            (void)behind("FUNCTION RESET TCPM", 0);
            tip_ = false;
            return;
        }
        constexpr std::string_view wanted = "FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS";
        if (!begins(wanted)) {
            refuse(words_.front().column,
                   "tool-tip control (TCPM) must be switched on with " + std::string(wanted));
        }
        (void)behind(wanted, 0);
        tip_ = true;
    }

    void miscellaneous(const Word& word) {
        if (word.text == "STOP") {
            add(StepKind::pause);
            return;
        }
        const int code = static_cast<int>(value_of(word, "M"));
        switch (code) {
        case 0:
            add(StepKind::pause);
            break;
        case 3:
            sense_ = 1.0;
            add(StepKind::spindle_on).value = rpm_;
            break;
        case 4:
            sense_ = -1.0;
            add(StepKind::spindle_on).value = -rpm_;
            break;
        case 5:
            sense_ = 0.0;
            add(StepKind::spindle_off);
            break;
        case 8:
            add(StepKind::coolant_on);
            break;
        case 9:
            add(StepKind::coolant_off);
            break;
        case 2:
        case 30:
            add(StepKind::end).tip = tip_;
            break;
        case 126: // rotary axes take the shorter way
        case 127:
            break;
        case 128:
        case 129:
            tip_ = code == 128;
            break;
        default:
            refuse(word.column, fmt::format("M{} is not supported", code));
        }
    }

    // ---- L

    struct Straight {
        AxisValues end;
        std::array<bool, axis_count> given{};
        bool rapid = false;
        bool machine = false;        ///< M91
        std::vector<Word> functions; ///< other M
    };

    void straight() {
        Straight line;
        bool fed = false;
        for (std::size_t n = 1; n < words_.size(); ++n) {
            const Word& word = words_[n];
            const std::size_t axis = axis_of(word.text.front());
            if (axis < axis_count) {
                take_axis(line, axis, word);
            } else if (word.text == "FMAX") {
                line.rapid = true;
            } else if (word.text.front() == 'F') {
                fed = true;
                feed_ = value_of(word, "F") * unit_;
            } else if (word.text == "M91") {
                line.machine = true;
            } else if (word.text.front() == 'M') {
                line.functions.push_back(word);
            } else if (word.text != "R0") {
                refuse(word.column, fmt::format("'{}' is not supported in an L block", word.text));
            }
        }
        if (line.rapid && fed) {
            refuse(words_.back().column, "FMAX and F cannot be in the same block");
        }
        for (const Word& word : line.functions) {
            if (acts_at_begin(word.text)) {
                miscellaneous(word);
            }
        }
        if (line.given != decltype(line.given)()) {
            go(line);
        }
        for (const Word& word : line.functions) {
            if (!acts_at_begin(word.text)) {
                miscellaneous(word);
            }
        }
    }

    /// Spindle and coolant are switched on, and tip control is switched, before the block moves.
    static bool acts_at_begin(std::string_view function) {
        constexpr std::array<std::string_view, 7> functions{"M3", "M4", "M8", "M03", "M04", "M08", "M128"};
        return std::ranges::find(functions, function) != functions.end();
    }

    static std::size_t axis_of(char letter) {
        return static_cast<std::size_t>(std::find(axis_letters.begin(), axis_letters.end(), letter) -
                                        axis_letters.begin());
    }

    void take_axis(Straight& line, std::size_t axis, const Word& word) const {
        if (std::exchange(line.given[axis], true)) {
            refuse(word.column, fmt::format("{} occurs twice", axis_letters[axis]));
        }
        const double value = value_of(word, word.text.substr(0, 1));
        line.end[axis] = is_rotary(axis) ? value : value * unit_;
    }

    void go(const Straight& line) {
        AxisValues end = at_;
        for (std::size_t n = 0; n < axis_count; ++n) {
            if (line.given[n]) {
                end[n] = line.end[n] + (line.machine ? 0.0 : rules_.work_offset[n]);
            }
        }
        if (line.machine && tip_) {
            refuse(1, "M91 can only be used with tool-tip control (TCPM) off");
        }
        WrittenStep& step = add(line.rapid ? StepKind::rapid : StepKind::feed);
        step.tip = tip_;
        step.target = end;
        if (!line.rapid) {
            step.value = duration(end);
        }
        at_ = end;
    }

    /// The feed counts along X Y Z where one of them moves, else in degrees.
    [[nodiscard]] double duration(const AxisValues& end) const {
        if (!(feed_ > 0.0)) {
            refuse(1, "a feed move has no feed rate");
        }
        constexpr double seconds_per_minute = 60.0;
        double way = linear_distance(at_, end);
        double feed = feed_;
        if (way <= same_place) {
            double sum = 0.0;
            for (const Axis axis : {Axis::a, Axis::b, Axis::c}) {
                sum += square(end[axis] - at_[axis]);
            }
            way = std::sqrt(sum);
            feed = feed_ / unit_;
        }
        return way / feed * seconds_per_minute;
    }
};

} // namespace

std::vector<WrittenStep> read_written_klartext(std::string_view text,
                                               const std::filesystem::path& file,
                                               const WrittenTextRules& rules) {
    Reader reader(file, rules);
    reader.read(text);
    return reader.take();
}

} // namespace millwright::gcode
