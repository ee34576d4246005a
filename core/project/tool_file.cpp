#include "core/project/tool_file.h"

#include "core/base/error.h"
#include "core/base/file_format.h"
#include "core/project/internal/setting_json.h"
#include "core/project/json_text.h"
#include "core/project/tool_json.h"
#include "core/project/tool_settings.h"

namespace millwright::project {

namespace {

constexpr std::string_view tool_format_name = "millwright-tool";
constexpr int tool_format_version = 1;

} // namespace

ToolInput tool_from(const JsonValue& value) {
    expect_fields<ToolInput>(value, tool_numbers(), {"cutter"});
    ToolInput result;
    result.cutter = choice(value.at("cutter"), cutter_kinds());
    read_numbers<ToolInput>(value, tool_numbers(), result);
    if (const std::string fault = fault_of(result); !fault.empty()) {
        value.fail(fault);
    }
    return result;
}

Json json_of(const ToolInput& tool) {
    Json json;
    json["cutter"] = row_of(cutter_kinds(), tool.cutter).id;
    add_numbers<ToolInput>(json, tool_numbers(), tool);
    return json;
}

ToolInput read_tool(const std::filesystem::path& file) {
    const JsonValue root = JsonValue::read(file);
    expect_format(root, tool_format_name, "a tool file");
    root.expect_only({"format", "version", "tool"});
    (void)root.at("version").integer(tool_format_version, tool_format_version);
    return tool_from(root.at("tool"));
}

std::string tool_file_text(const ToolInput& tool) {
    if (const std::string fault = fault_of(tool); !fault.empty()) {
        throw Error(fault);
    }
    Json json;
    json["format"] = tool_format_name;
    json["version"] = tool_format_version;
    json["tool"] = json_of(tool);
    return json_text(json);
}

} // namespace millwright::project
