// Whether something may be done now, and the sentence that says why not.
#pragma once

#include <string>
#include <utility>

namespace millwright::widgets {

struct Permission {
    bool allowed = true;
    std::string reason; ///< a whole sentence for people; shown as the tip of what is greyed out

    [[nodiscard]] static Permission refused(std::string why) { return {false, std::move(why)}; }
    friend bool operator==(const Permission&, const Permission&) = default;
};

} // namespace millwright::widgets
