#include "core/emulators/grbl/internal/eeprom_image.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>

namespace millwright::emulators::internal {

namespace {

constexpr double erase_and_write_time = 3.4e-3; // data sheet of the ATmega328P
constexpr double erase_or_write_time = 1.8e-3;
constexpr std::size_t eeprom_line_size = 80;

using Record = std::vector<std::uint8_t>;

void append(Record& record, double value) {
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
    for (unsigned shift = 0; shift < 32; shift += 8) {
        record.push_back(static_cast<std::uint8_t>(bits >> shift));
    }
}

Record settings_record(const Eeprom& eeprom) {
    Record record;
    for (const Setting& setting : eeprom.settings) {
        if (setting.decimals > 0) {
            append(record, setting.value);
        } else {
            record.push_back(static_cast<std::uint8_t>(static_cast<std::int64_t>(setting.value)));
        }
    }
    return record;
}

Record offset_record(const Axes& axes, std::size_t count) {
    Record record;
    for (std::size_t n = 0; n < count; ++n) {
        append(record, axes[n]);
    }
    return record;
}

Record line_record(const std::string& text) {
    Record record(eeprom_line_size, 0);
    std::copy_n(text.begin(), std::min(text.size(), record.size()), record.begin());
    return record;
}

/// Each record is followed by a checksum of its bytes.
std::vector<Record> records_of(const Eeprom& eeprom) {
    std::vector<Record> records{settings_record(eeprom)};
    for (const Axes& offset : eeprom.work_offsets) {
        records.push_back(offset_record(offset, eeprom.axis_count));
    }
    records.push_back(offset_record(eeprom.g28, eeprom.axis_count));
    records.push_back(offset_record(eeprom.g30, eeprom.axis_count));
    for (const std::string& line : eeprom.startup_lines) {
        records.push_back(line_record(line));
    }
    records.push_back(line_record(eeprom.build_text));
    for (Record& record : records) {
        std::uint8_t checksum = 0;
        for (const std::uint8_t byte : record) {
            checksum = static_cast<std::uint8_t>((checksum << 1U) + (checksum >> 7U) + byte);
        }
        record.push_back(checksum);
    }
    return records;
}

/// Bits are cleared by writing and set by erasing the whole byte; only a byte that needs both takes longer.
double write_time(std::uint8_t before, std::uint8_t after) {
    constexpr std::uint8_t erased = 0xff;
    const bool erases = (~before & after) != 0;
    return erases && after != erased ? erase_and_write_time : erase_or_write_time;
}

} // namespace

std::vector<double> eeprom_pauses(const Eeprom& before, const Eeprom& after) {
    std::vector<double> pauses;
    const std::vector<Record> old_records = records_of(before);
    const std::vector<Record> new_records = records_of(after);
    for (std::size_t n = 0; n < new_records.size(); ++n) {
        for (std::size_t byte = 0; byte + 1 < new_records[n].size(); ++byte) {
            if (old_records[n][byte] != new_records[n][byte]) {
                pauses.push_back(write_time(old_records[n][byte], new_records[n][byte]));
            }
        }
    }
    return pauses;
}

} // namespace millwright::emulators::internal
