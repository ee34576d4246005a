// A talk with an emulated card, in its own time.
#pragma once

#include "core/base/error.h"
#include "core/pmac_service/card_talk.h"
#include "tests/core/pmac/emulator/pmac_card.h"

#include <algorithm>
#include <string>

namespace millwright::test {

/// `pmac` must outlive it.
inline pmac::CardTalk talk_to(PmacCard& pmac) {
    return {.ask =
                [&pmac](const std::string& lines) {
                    std::string answer;
                    for (std::size_t at = 0; at < lines.size();) {
                        const std::size_t end = std::min(lines.find('\n', at), lines.size());
                        const std::string line = lines.substr(at, end - at);
                        answer = pmac.ask(line);
                        if (answer.starts_with("ERR")) {
                            throw Error(line + ": " + answer);
                        }
                        at = end + 1;
                    }
                    std::ranges::replace(answer, '|', '\n');
                    return answer;
                },
            .wait = [&pmac](double seconds) { pmac.card.advance(seconds); }};
}

} // namespace millwright::test
