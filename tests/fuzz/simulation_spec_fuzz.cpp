// Any text is a stock or a tool: it gives one without a fault, a file to read, or an error that says what can
// be written; never a crash or NaN.
#include "core/base/error.h"
#include "core/simulation/spec_text.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace {

using namespace millwright;             // NOLINT(google-build-using-namespace)
using namespace millwright::simulation; // NOLINT(google-build-using-namespace)

void read_stock(std::string_view text) {
    try {
        const StockText found = parse_stock(text);
        expects(found.stock.has_value() == found.mesh_file.empty(), "a stock is a shape or a file");
        if (found.stock) {
            expects(fault_of(*found.stock).empty(), "a stock that was read has no fault");
            expects(volume(*found.stock) > 0.0, "a stock has a volume");
            expects(is_finite(bounds(*found.stock).min()), "a stock is finite");
        }
    } catch (const Error& error) {
        expects(!error.diagnostic().hint.empty(), "an error says what can be written");
    }
}

void read_tool(std::string_view text) {
    try {
        const ToolText found = parse_tool(text);
        expects(found.body.has_value() == found.file.empty(), "a tool is a shape or a file");
        expects(!found.number || *found.number >= 0, "a number is one of T");
    } catch (const Error& error) {
        expects(!error.diagnostic().hint.empty(), "an error says what can be written");
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    read_stock(text);
    read_tool(text);
    return 0;
}
