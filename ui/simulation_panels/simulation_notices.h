// What a person should know of a simulation of the stock, as banners.
#pragma once

#include "core/base/error.h"
#include "core/plan/stock_simulation.h"
#include "ui/widgets/notices.h"

#include <string>
#include <vector>

namespace millwright::panels {

/// How many collisions and near misses there are, and what was not checked. Good only where all was.
[[nodiscard]] widgets::Notice collision_notice(const plan::StockResult& result);

/// "Line 5: ..." where the place has a line; message and hint as sentences.
[[nodiscard]] std::string sentence_of(const Diagnostic& diagnostic);

} // namespace millwright::panels
