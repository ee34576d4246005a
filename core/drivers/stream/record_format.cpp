#include "core/drivers/stream/record_format.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/base/text.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace millwright::drivers {

RecordText::RecordText(const RecordFormat& format, const kinematics::MachineModel& model, int decimals)
    : axes_(static_cast<std::size_t>(model.axis_count())), decimals_(decimals) {
    const auto refuse = [&](const std::string& why) {
        throw Error(fmt::format("the record '{}': {}", format.pattern, why),
                    {},
                    "write axis letters in braces, and {a} and {s}, as in 't {X} {Y} {Z} {a} {s}'");
    };
    if (!(format.patience > 0.0) || !std::isfinite(format.patience)) {
        throw Error(fmt::format("the time limit of {} s for an answer must be above 0", format.patience));
    }
    if (format.pattern.find_first_of("\r\n") != std::string::npos) {
        refuse("it contains a line break");
    }
    std::string_view rest = format.pattern;
    bool moves = false;
    for (auto open = rest.find('{'); open != std::string_view::npos; open = rest.find('{')) {
        const auto close = rest.find('}', open);
        if (close == std::string_view::npos) {
            refuse("a brace is not closed");
        }
        const std::string_view name = rest.substr(open + 1, close - open - 1);
        Field field{std::string(rest.substr(0, open)), -1, 0};
        if (name == "a" || name == "s") {
            field.other = name.front();
        } else if (name.size() == 1 && model.axis_index(name.front()) >= 0) {
            field.axis = model.axis_index(name.front());
            moves = true;
        } else {
            refuse(fmt::format("'{}' does not exist on {}", name, model.name()));
        }
        if (!fields_.empty() && field.before.empty()) {
            refuse("two numbers have no separator");
        }
        fields_.push_back(std::move(field));
        rest.remove_prefix(close + 1);
    }
    if (!moves) {
        refuse("it contains no axis");
    }
    behind_ = rest;
}

std::string RecordText::written(const Record& record) const {
    std::string text;
    for (const Field& field : fields_) {
        const double value = field.axis >= 0      ? record.axes[static_cast<std::size_t>(field.axis)]
                             : field.other == 'a' ? record.acceleration
                                                  : record.speed;
        text += field.before + fixed(value, decimals_);
    }
    return text + behind_;
}

std::optional<Record> RecordText::read(std::string_view line) const {
    Record record{std::vector<double>(axes_), 0.0, 0.0};
    for (const Field& field : fields_) {
        if (!line.starts_with(field.before)) {
            return std::nullopt;
        }
        line.remove_prefix(field.before.size());
        double value = 0.0;
        const auto [end, fault] = std::from_chars(line.data(), line.data() + line.size(), value);
        if (fault != std::errc() || !std::isfinite(value)) {
            return std::nullopt;
        }
        line.remove_prefix(static_cast<std::size_t>(end - line.data()));
        (field.axis >= 0      ? record.axes[static_cast<std::size_t>(field.axis)]
         : field.other == 'a' ? record.acceleration
                              : record.speed) = value;
    }
    return line == behind_ ? std::optional(record) : std::nullopt;
}

void RecordText::expect_all_told(const program::Program& program,
                                 const kinematics::MachineModel& model) const {
    std::vector<bool> silent(axes_, true);
    for (const Field& field : fields_) {
        if (field.axis >= 0) {
            silent[static_cast<std::size_t>(field.axis)] = false;
        }
    }
    for (const program::Block& block : program.blocks) {
        for (int n = 0; n < model.axis_count(); ++n) {
            const bool moves = block.target.size() > n && std::abs(block.target[n] - program.start[n]) > 0.0;
            if (moves && silent[static_cast<std::size_t>(n)]) {
                throw Error(fmt::format("the program moves {}, which the record does not contain",
                                        model.axis(n).letter),
                            {},
                            fmt::format("add {{{}}} to the record", model.axis(n).letter));
            }
        }
    }
}

double RecordPath::unit_of(int decimals) {
    return std::pow(10.0, -decimals);
}

std::vector<std::int64_t> RecordPath::in_units(const std::vector<double>& position) const {
    std::vector<std::int64_t> units;
    for (const double value : position) {
        expects(std::isfinite(value), "a position that is sent is finite");
        units.push_back(std::llround(value / unit_));
    }
    return units;
}

void RecordPath::begin(const std::vector<double>& position) {
    at_ = in_units(position);
    speed_ = 0.0;
}

Record RecordPath::to(const std::vector<double>& position, const std::vector<bool>& linear) {
    const std::vector<std::int64_t> units = in_units(position);
    Record record;
    double way = 0.0;
    for (std::size_t n = 0; n < units.size(); ++n) {
        const double step = static_cast<double>(units[n] - at_[n]) * unit_;
        record.axes.push_back(relative_ ? step : static_cast<double>(units[n]) * unit_);
        way += linear[n] ? square(step) : 0.0;
    }
    record.speed = std::sqrt(way) / period_;
    record.acceleration = (record.speed - speed_) / period_;
    speed_ = record.speed;
    at_ = units;
    return record;
}

} // namespace millwright::drivers
