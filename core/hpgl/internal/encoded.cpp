// PE: a polyline as bytes, seven or eight bits, numbers to the base 32 or 64 (HP-GL/2 reference guide, PE).
#include "core/hpgl/internal/moves.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace millwright::hpgl::internal {
namespace {

struct Step {
    enum class Kind { draw, move, pen } kind = Kind::draw;
    bool absolute = false;
    Vec2 to = Vec2::Zero();
    int pen = 0;
};

/// Decodes all of it before anything is drawn.
class PolylineDecoder {
public:
    explicit PolylineDecoder(std::string_view bytes) : bytes_(bytes) {}

    /// Up to what is wrong.
    std::vector<Step> decode() {
        while (skip_controls(), !wrong_ && at_ < bytes_.size()) {
            if (!flag()) {
                point();
            }
        }
        if (up_ || absolute_) {
            refuse("PE: a flag has no point after it");
        }
        return std::move(steps_);
    }

    /// What is wrong first.
    [[nodiscard]] const std::optional<std::string>& wrong() const { return wrong_; }

private:
    void refuse(std::string why) {
        if (!wrong_) {
            wrong_ = std::move(why);
        }
    }

    void skip_controls() {
        while (at_ < bytes_.size() && static_cast<unsigned char>(bytes_[at_]) <= ' ') {
            ++at_;
        }
    }

    bool flag() {
        switch (bytes_[at_]) {
        case '7':
            base_ = 32;
            break;
        case '<':
            up_ = true;
            break;
        case '=':
            absolute_ = true;
            break;
        case ':':
            ++at_;
            steps_.push_back({.kind = Step::Kind::pen, .pen = whole("pen number", 0.0, 32767.0)});
            return true;
        case '>':
            ++at_;
            fraction_ = std::ldexp(1.0, -whole("number of fractional bits", 0.0, 30.0));
            return true;
        default:
            return false;
        }
        ++at_;
        return true;
    }

    void point() {
        const double x = number();
        if (skip_controls(), at_ >= bytes_.size()) {
            return refuse("PE: a point has no y");
        }
        const double y = number();
        constexpr double largest = 1073741824.0;
        if (!(std::abs(x) <= largest && std::abs(y) <= largest)) {
            return refuse("PE: a coordinate exceeds 2^30");
        }
        steps_.push_back({.kind = up_ ? Step::Kind::move : Step::Kind::draw,
                          .absolute = absolute_,
                          .to = Vec2(x, y) * fraction_});
        up_ = false;
        absolute_ = false;
    }

    int whole(const char* what, double least, double most) {
        const double value = number();
        if (value < least || value > most) {
            refuse(fmt::format("PE: {} is not a valid {}", value, what));
            return 0;
        }
        return static_cast<int>(value);
    }

    // Digits from the lowest; the last one is recognised by its range. Bit 0 is the sign.
    double number() {
        double value = 0.0;
        double place = 1.0;
        for (int digit = 0; digit < most_digits; ++digit) {
            skip_controls();
            if (at_ >= bytes_.size()) {
                refuse("PE: the data ends in the middle of a number");
                return 0.0;
            }
            const int code = static_cast<unsigned char>(bytes_[at_++]);
            const int last = base_ == 64 ? 191 : 95;
            const bool ends = code >= last && code < last + base_;
            if (!ends && !(code >= 63 && code < 63 + base_)) {
                refuse(fmt::format("PE: the byte {:02X} is not a digit to base {}", code, base_));
                return 0.0;
            }
            value += place * (code - (ends ? last : 63));
            place *= base_;
            if (ends) {
                const double half = std::floor(value / 2.0);
                return value > 2.0 * half ? -half : half;
            }
        }
        refuse("PE: a number has more digits than any coordinate");
        return 0.0;
    }

    static constexpr int most_digits = 10;
    std::string_view bytes_;
    std::size_t at_ = 0;
    int base_ = 64;
    double fraction_ = 1.0;
    bool up_ = false;
    bool absolute_ = false;
    std::vector<Step> steps_;
    std::optional<std::string> wrong_;
};

void follow_step(Run& run, const Step& step) {
    if (step.kind == Step::Kind::pen) {
        run.pen.select(step.pen);
        return;
    }
    if (step.kind == Step::Kind::move) {
        run.pen.lift();
    } else {
        run.pen.lower();
    }
    if (step.absolute) {
        run.pen.go(run.units.plotter(step.to));
    } else {
        run.pen.step(run.units.plotter_step(step.to));
    }
}

} // namespace

void encoded_polyline(Run& run, const Given& given) {
    PolylineDecoder decoder(given.command.arguments);
    const std::vector<Step> steps = decoder.decode();
    if (decoder.wrong()) {
        return run.refuse(*decoder.wrong());
    }
    for (const Step& step : steps) {
        if (step.kind == Step::Kind::pen && step.pen > run.settings.highest_pen) {
            return run.refuse(fmt::format("PE: pen {} does not exist", step.pen));
        }
    }
    for (const Step& step : steps) {
        follow_step(run, step);
    }
}

} // namespace millwright::hpgl::internal
