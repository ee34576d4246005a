#include "ui/simulation_panels/simulation_notices.h"

#include "core/base/counted.h"
#include "core/base/sentences.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace millwright::panels {

widgets::Notice collision_notice(const plan::StockResult& result) {
    using widgets::Severity;
    const auto near =
        std::ranges::count(result.events, plan::StockEventKind::near_miss, &plan::StockEvent::kind);
    const auto collisions = std::ssize(result.events) - near;
    const bool whole = result.unchecked.empty();
    std::string text = collisions > 0
                           ? counted(collisions, "collision or fault", "collisions and faults") + "."
                           : std::string(whole ? "No collisions." : "No collisions found.");
    if (near > 0) {
        text += fmt::format(" {}.", counted(near, "near miss", "near misses"));
    }
    for (const std::string& sentence : result.unchecked) {
        text += " Not checked: " + with_full_stop(sentence);
    }
    const Severity severity = collisions > 0 ? Severity::danger : whole ? Severity::good : Severity::info;
    return {severity, text, {}};
}

std::string sentence_of(const Diagnostic& diagnostic) {
    const std::string line =
        diagnostic.place.line > 0 ? fmt::format("Line {}: ", diagnostic.place.line) : std::string();
    std::string text = line + as_sentence(diagnostic.message);
    return diagnostic.hint.empty() ? text : with_sentence(std::move(text), as_sentence(diagnostic.hint));
}

} // namespace millwright::panels
