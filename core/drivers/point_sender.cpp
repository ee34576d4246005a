#include "core/drivers/point_sender.h"

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/units.h"

#include <fmt/format.h>

#include <utility>

namespace millwright::drivers {

using kinematics::AxisKind;
using kinematics::AxisPositions;

namespace {

PointFormat checked_format(PointFormat format) {
    constexpr int most_decimals = 9;
    if (format.decimals < 0 || format.decimals > most_decimals) {
        throw Error(fmt::format("{} decimals are not between 0 and {}", format.decimals, most_decimals));
    }
    return format;
}

std::string stream_heading(double period, const kinematics::MachineModel& model) {
    std::string text = fmt::format("# millwright-stream 1 period_s {}", period);
    for (const kinematics::MachineAxis& axis : model.axes()) {
        text += fmt::format(" {} {}", axis.letter, axis.kind == AxisKind::rotary ? "deg" : "mm");
    }
    return text + "\n";
}

} // namespace

PointSender::PointSender(PointFormat format, const kinematics::MachineModel& model)
    : format_(checked_format(std::move(format))),
      path_(format_.record && format_.record->relative, format_.period, format_.decimals) {
    for (const kinematics::MachineAxis& axis : model.axes()) {
        linear_.push_back(axis.kind == AxisKind::linear);
    }
    if (format_.record) {
        text_.emplace(*format_.record, model, format_.decimals);
    } else {
        heading_ = stream_heading(format_.period, model);
    }
}

void PointSender::expect_all_told(const program::Program& program,
                                  const kinematics::MachineModel& model) const {
    if (text_) {
        text_->expect_all_told(program, model);
    }
}

void PointSender::begin(const AxisPositions& position) {
    if (text_) {
        path_.begin(values_of(position));
    }
    owed_ = false;
}

std::string PointSender::to(const AxisPositions& position) {
    return text_ ? written(path_.to(values_of(position), linear_)) : line(position);
}

std::string PointSender::to(const AxisPositions& position, double speed, double acceleration) {
    Record record = path_.to(values_of(position), linear_);
    record.speed = speed;
    record.acceleration = acceleration;
    return written(record);
}

std::string PointSender::written(const Record& record) {
    owed_ = asks();
    return text_->written(record) + format_.record->ending;
}

std::string PointSender::line(const AxisPositions& position) const {
    std::string text;
    for (const double value : values_of(position)) {
        text += (text.empty() ? "" : " ") + fixed(value, format_.decimals);
    }
    return text + "\n";
}

std::optional<PointSender::Heard> PointSender::hear(std::string_view bytes) {
    inbox_.add(bytes);
    std::optional<std::string> line = inbox_.next();
    if (!line) {
        return std::nullopt;
    }
    const bool owed = std::exchange(owed_, false);
    const bool right = format_.record && *line == format_.record->answer;
    return Heard{!owed ? Answer::unasked : right ? Answer::right : Answer::wrong, *std::move(line)};
}

std::vector<double> PointSender::values_of(const AxisPositions& position) const {
    std::vector<double> values;
    for (std::size_t n = 0; n < linear_.size(); ++n) {
        const double value = position[static_cast<Eigen::Index>(n)];
        values.push_back(linear_[n] ? value : to_degrees(value));
    }
    return values;
}

} // namespace millwright::drivers
