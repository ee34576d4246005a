#include "tests/core/gcode/read_program.h"

#include "core/gcode/canon_printer.h"

#include <stdexcept>

namespace millwright::test {

namespace {

class CanonKeeper final : public gcode::CanonSink {
public:
    explicit CanonKeeper(ReadProgram& into)
        : into_(into), printer_([this](std::string_view text) { text_ += text; }) {}

    void move(const gcode::Move& move, const gcode::SourceLine& now) override {
        into_.moves.push_back(move);
        printer_.move(move, now);
    }
    void curve(const gcode::Curve& curve, const gcode::SourceLine& now) override {
        into_.curves.push_back({{curve.points.begin(), curve.points.end()}, curve.order});
        printer_.curve(curve, now);
    }
    void command(const gcode::Command& command, const gcode::SourceLine& now) override {
        into_.commands.push_back({command, std::string(command.text)});
        into_.commands.back().command.text = {};
        printer_.command(command, now);
    }

    void finish() {
        printer_.flush();
        for (std::size_t at = 0; at < text_.size();) {
            const std::size_t end = text_.find('\n', at);
            std::string line = text_.substr(at, end - at);
            constexpr std::size_t before_command = 13;
            into_.canon.push_back(line.size() > before_command && line[6] == 'N' ? line.substr(before_command)
                                                                                 : line);
            at = end + 1;
        }
    }

private:
    ReadProgram& into_;
    gcode::CanonPrinter printer_;
    std::string text_;
};

} // namespace

std::vector<std::string> ReadProgram::lines_of(std::string_view word) const {
    std::vector<std::string> found;
    for (const std::string& line : canon) {
        if (line.starts_with(word)) {
            found.push_back(line);
        }
    }
    return found;
}

ReadProgram read_all(const std::string& text, const gcode::ReaderSettings& settings) {
    ReadProgram result;
    CanonKeeper keeper(result);
    gcode::Interpreter program(text, "test.ngc", settings, keeper);
    program.run();
    keeper.finish();
    result.errors = program.errors();
    result.state = program.state();
    result.lines = program.line_count();
    return result;
}

ReadProgram read(const std::string& text, const gcode::ReaderSettings& settings) {
    return read_all(text + "\nM2\n", settings);
}

std::vector<std::array<double, 3>> ends_of(const std::string& text) {
    const ReadProgram program = read(text);
    if (!program.errors.empty()) {
        throw std::runtime_error(to_text(program.errors.front()));
    }
    std::vector<std::array<double, 3>> ends;
    for (const gcode::Move& move : program.moves) {
        ends.push_back(
            {move.target[gcode::Axis::x], move.target[gcode::Axis::y], move.target[gcode::Axis::z]});
    }
    return ends;
}

std::string error_of(const std::string& text, const gcode::ReaderSettings& settings) {
    const ReadProgram program = read(text, settings);
    if (program.errors.empty()) {
        return {};
    }
    const Diagnostic& found = program.errors.front();
    return std::to_string(found.place.line) + ":" + std::to_string(found.place.column) + ": " + found.message;
}

} // namespace millwright::test
