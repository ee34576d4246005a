// What people type into a number field: 12.7, 25.4/2, (3+4)*2, sqrt(2), 12.7 mm. The one home of muParser
// here.
#pragma once

#include "ui/widgets/field_info.h"

#include <optional>
#include <string>
#include <string_view>

namespace millwright::widgets {

/// A finite value, or the sentence that says what is wrong with the text.
struct Evaluated {
    std::optional<double> value;
    std::string reason; ///< empty exactly when there is a value
};

/// The value of `text`: numbers with a point, + - * / ^, brackets and muParser's functions (angles in
/// radians). A trailing `unit` is ignored. A decimal comma is refused, never read as something else.
[[nodiscard]] Evaluated evaluate(std::string_view text, std::string_view unit = {});

/// The same, and inside the field's range.
[[nodiscard]] Evaluated evaluate_number(std::string_view text, const FieldInfo& info);
/// The same, and a whole number.
[[nodiscard]] Evaluated evaluate_integer(std::string_view text, const FieldInfo& info);

} // namespace millwright::widgets
