// Value Change Dumps as values over time, read by a reader that knows nothing of the writer.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <sstream>
#include <string>

namespace millwright::test {

struct Waves {
    std::map<std::string, std::map<std::int64_t, std::uint64_t>> changes; ///< name -> time -> value
    std::map<std::string, int> bits;

    /// The value of a signal at a time.
    [[nodiscard]] std::uint64_t at(const std::string& name, std::int64_t time) const {
        const auto& all = changes.at(name);
        auto after = all.upper_bound(time);
        EXPECT_NE(after, all.begin()) << name << " has no value at " << time;
        return (--after)->second;
    }
};

/// A reader of Value Change Dumps that knows nothing of the writer.
inline Waves read_waves(const std::string& text) {
    Waves waves;
    std::map<std::string, std::string> names;
    std::istringstream in(text);
    std::string word;
    std::int64_t time = -1;
    while (in >> word) {
        if (word == "$var") {
            std::string kind, code, name;
            int bits = 0;
            in >> kind >> bits >> code >> name;
            names[code] = name;
            waves.bits[name] = bits;
            while (word != "$end") {
                in >> word;
            }
        } else if (word == "$dumpvars" || word == "$end") {
            continue; // values follow, or have come
        } else if (word[0] == '$') {
            while (word != "$end") {
                in >> word;
            }
        } else if (word[0] == '#') {
            const std::int64_t next = std::stoll(word.substr(1));
            EXPECT_GT(next, time);
            time = next;
        } else if (word[0] == 'b') {
            std::string code;
            in >> code;
            EXPECT_LE(static_cast<int>(word.size()) - 1, waves.bits.at(names.at(code)));
            waves.changes[names.at(code)][time] = std::stoull(word.substr(1), nullptr, 2);
        } else {
            waves.changes[names.at(word.substr(1))][time] = word[0] == '1' ? 1 : 0;
        }
    }
    return waves;
}

} // namespace millwright::test
