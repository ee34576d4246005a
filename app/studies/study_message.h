// What the ranks of a study tell rank 0: where they are, the rows of a case that is done, that they are at
// their end.
#pragma once

#include "core/studies/kinematic_study.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::app {

struct StudyMessage {
    std::optional<std::size_t> at = {};                      ///< index of the case that it is about
    double fraction = 0.0;                                   ///< of that case
    std::string text = {};                                   ///< what is being done, or why it failed
    std::optional<std::vector<studies::StudyRow>> rows = {}; ///< of the case, which is done
    bool failed = false;
    bool ended = false; ///< nothing more comes
};

/// Figures to the last bit.
[[nodiscard]] std::string packed(const StudyMessage& message);
/// Throws Error if these are none of our bytes.
[[nodiscard]] StudyMessage unpacked(std::string_view bytes);

} // namespace millwright::app
