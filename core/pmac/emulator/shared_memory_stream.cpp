#include "core/pmac/emulator/shared_memory_stream.h"

#include "core/base/error.h"
#include "core/pmac/emulator/pmac_emulator.h"
#include "core/pmac/emulator/pmac_host_port.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace millwright::pmac {
namespace {

// Offsets in the RAM as the computer sees it, in bytes: words of 32 bits from $D201 on, flags in $D200.
constexpr std::array<int, 3> word_offsets = {0x0804, 0x0808, 0x080C};
constexpr int run_offset = 0x0800;
constexpr int ready_offset = 0x0802;

constexpr std::array<double, 3> counts_per_degree = {120.0, 222.0, 150.0}; // the axes of the thesis
constexpr double words_per_degree = 1000.0;
constexpr double largest_word = 8388607.0; // the card's words have 24 bits
constexpr double tick = 5e-4;              // s; some servo cycles' time
constexpr double least_move_ms = 10.0;
constexpr int equ1 = 0x20; // of the interrupt controller's inputs

double move_ms(const std::vector<SharedMemoryStream::Point>& points, double deg_per_s) {
    double farthest = 0.0;
    for (std::size_t n = 1; n < points.size(); ++n) {
        for (std::size_t axis = 0; axis < word_offsets.size(); ++axis) {
            farthest = std::max(farthest, std::abs(points[n][axis] - points[n - 1][axis]));
        }
    }
    constexpr double ms = 1000.0;
    return std::max(least_move_ms, std::ceil(ms * farthest / deg_per_s));
}

/// Axes and gains, the M-variables of the thesis, and a program that takes point by point.
std::string card_lines(double time_ms) {
    return fmt::format("I100=1\nI200=1\nI300=1\n#1->120X\n#2->222Y\n#3->150Z\n#1J/\n#2J/\n#3J/\n"
                       "I117=1000\nI217=1000\nI317=1000\nI187={}\nI188=0\nI8=0\n"
                       "M112->X:$C000,12\nM113->X:$C000,13\nM112=1\nM113=0\n"
                       "M151->DP:$D201\nM152->DP:$D202\nM153->DP:$D203\nM154->Y:$D200,0\nM155->X:$D200,0\n"
                       "M151=0\nM152=0\nM153=0\nM154=1\nM155=0\n"
                       "OPEN PROG 2\nCLEAR\nABS LINEAR TM{}\n"
                       "WHILE(M154=1)\nIF(M155=1)\nX(M151/1000)Y(M152/1000)Z(M153/1000)\n"
                       "M155=0\nM113=1 M113=0\nENDIF\nENDWHILE\nCLOSE\n&1B2R\n",
                       std::floor(time_ms / 2.0),
                       time_ms);
}

} // namespace

class SharedMemoryStream::Body {
public:
    Body(std::vector<Point> points, double deg_per_s)
        : points_(std::move(points)), move_ms_(move_ms(points_, deg_per_s)) {
        initialise_interrupts();
        std::string line;
        for (const char c : card_lines(move_ms_)) {
            if (c == '\n') {
                say(std::exchange(line, {}));
            } else {
                line += c;
            }
        }
        begin_ = card_.time();
        look();
    }

    void advance(double seconds) {
        if (hand_over()) {
            return; // so that the point is seen waiting
        }
        if (buffer_.taken == count()) {
            stop();
        }
        const double end = card_.time() + seconds;
        const int taken = buffer_.taken;
        while (card_.time() < end && !finished() && buffer_.taken == taken) {
            port_.advance(tick);
            serve_interrupt();
            look();
            if (buffer_.runs && !card_.program_runs(1)) {
                throw Error("the card ended its program",
                            {},
                            "check for a following error or a limit, and choose a lower speed");
            }
        }
    }

    void stop() {
        stopped_ = true;
        card_.set_shared_16(run_offset, 0);
        look();
    }
    [[nodiscard]] bool finished() const { return stopped_ && !card_.moving(); }
    [[nodiscard]] const SharedMemoryBuffer& buffer() const { return buffer_; }
    [[nodiscard]] int count() const { return static_cast<int>(points_.size()); }
    [[nodiscard]] double move_time() const {
        constexpr double ms = 1000.0;
        return move_ms_ / ms;
    }

private:
    /// As the thesis sets the card's interrupt controller up: edges, IR5 alone, automatic end.
    void initialise_interrupts() {
        constexpr std::array<std::pair<int, std::uint8_t>, 6> words = {
            {{0, 0}, {8, 0x17}, {9, 0x08}, {9, 0x03}, {9, 0xDF}, {0, 0x81}}};
        for (const auto& [offset, value] : words) {
            port_.write(offset, value);
        }
    }

    /// Character by character, each when the card is ready for it.
    void say(const std::string& line) {
        constexpr unsigned has_character = 1U, takes_character = 2U;
        constexpr int status = 2, data = 7;
        for (const char c : line + "\r") {
            while ((port_.read(status) & takes_character) == 0) {
                port_.advance(tick);
            }
            port_.write(data, static_cast<std::uint8_t>(c));
        }
        port_.advance(2.0 * tick);
        std::string answer;
        while ((port_.read(status) & has_character) != 0) {
            answer += static_cast<char>(port_.read(data));
        }
        expects(answer.find('\a') == std::string::npos, "the card takes our lines");
    }

    /// The main loop of the thesis: the next point once the one before was taken.
    bool hand_over() {
        const bool free = buffer_.sent == buffer_.taken && !buffer_.ready;
        if (stopped_ || !free || buffer_.sent == count()) {
            return false;
        }
        const Point& point = points_[static_cast<std::size_t>(buffer_.sent)];
        for (std::size_t axis = 0; axis < point.size(); ++axis) {
            card_.set_shared_32(word_offsets[axis],
                                static_cast<std::int32_t>(std::lround(words_per_degree * point[axis])));
        }
        card_.set_shared_16(ready_offset, 1);
        ++buffer_.sent;
        look();
        return true;
    }

    /// The interrupt routine of the thesis.
    void serve_interrupt() {
        if (!port_.interrupts()) {
            return;
        }
        constexpr int control = 8, acknowledge = 10;
        constexpr std::uint8_t end_of_interrupt = 0x40, in_service = 0x0B;
        port_.write(acknowledge, end_of_interrupt);
        port_.write(control, end_of_interrupt);
        port_.write(acknowledge, in_service);
        buffer_.taken += (port_.read(control) & equ1) != 0 ? 1 : 0;
        port_.write(control, end_of_interrupt);
    }

    void look() {
        buffer_.time = card_.time() - begin_;
        buffer_.runs = card_.shared_16(run_offset) != 0;
        buffer_.ready = card_.shared_16(ready_offset) != 0;
        for (std::size_t axis = 0; axis < word_offsets.size(); ++axis) {
            buffer_.words[axis] = card_.shared_32(word_offsets[axis]);
            buffer_.position[axis] = card_.position(static_cast<int>(axis) + 1) / counts_per_degree[axis];
        }
    }

    PmacEmulator card_;
    PmacHostPort port_{card_};
    std::vector<Point> points_;
    double move_ms_;
    double begin_ = 0.0;
    bool stopped_ = false;
    SharedMemoryBuffer buffer_;
};

SharedMemoryStream::SharedMemoryStream(std::vector<Point> points, double deg_per_s) {
    if (points.empty()) {
        throw Error("there are no points to stream");
    }
    expects(deg_per_s > 0.0, "a speed is above 0");
    for (const Point& point : points) {
        for (const double value : point) {
            if (!(std::abs(value) * words_per_degree <= largest_word)) {
                throw Error(fmt::format("{} degrees do not fit into a word of the card", value),
                            {},
                            fmt::format("use up to {:.3f}", largest_word / words_per_degree));
            }
        }
    }
    body_ = std::make_unique<Body>(std::move(points), deg_per_s);
}

SharedMemoryStream::~SharedMemoryStream() = default;

void SharedMemoryStream::advance(double seconds) {
    body_->advance(seconds);
}
const SharedMemoryBuffer& SharedMemoryStream::buffer() const {
    return body_->buffer();
}
int SharedMemoryStream::count() const {
    return body_->count();
}
double SharedMemoryStream::move_time() const {
    return body_->move_time();
}
bool SharedMemoryStream::finished() const {
    return body_->finished();
}
void SharedMemoryStream::stop() {
    body_->stop();
}

} // namespace millwright::pmac
