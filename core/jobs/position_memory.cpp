#include "core/jobs/position_memory.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/json.h"
#include "core/drivers/driver.h"
#include "core/jobs/job.h"

#include <nlohmann/json.hpp>

#include <system_error>
#include <utility>

namespace millwright::jobs {

namespace {

constexpr std::string_view position_doubt_format_name = "millwright-position-doubt";
constexpr int position_doubt_format_version = 1;

struct KeptDoubt {
    std::string why;
    bool lost = true;
    bool moving = false;
};

KeptDoubt read_doubt(const std::filesystem::path& file) {
    const JsonValue whole = JsonValue::read(file);
    whole.expect_only({"format", "version", "controller", "doubt", "lost", "moving"});
    if (whole.at("format").text() != position_doubt_format_name) {
        whole.at("format").fail("this is not a position record");
    }
    (void)whole.at("version").integer(1, position_doubt_format_version);
    const auto lost = whole.find("lost");
    const auto moving = whole.find("moving");
    return {whole.at("doubt").text(), !lost || lost->flag(), moving && moving->flag()};
}

} // namespace

PositionMemory::PositionMemory(std::filesystem::path folder, std::string controller)
    : folder_(std::move(folder)), file_(folder_ / ("doubt-" + program_hash(controller) + ".json")),
      controller_(std::move(controller)) {}

void PositionMemory::remind(drivers::Driver& driver) {
    if (!std::filesystem::exists(file_)) {
        return;
    }
    try {
        const KeptDoubt doubt = read_doubt(file_);
        kept_ = doubt.why;
        kept_lost_ = doubt.lost;
        kept_moving_ = doubt.moving;
    } catch (const Error& error) {
        kept_lost_ = true;
        kept_ = "the position record of the last connection cannot be read: " + to_text(error.diagnostic());
    }
    // Found as if it had been switched on.
    if (const bool anew = !driver.status().position_doubt.empty(); kept_moving_ && anew && !kept_lost_) {
        kept_ =
            "the machine was running when it was last connected, and has been reset or switched off since";
        kept_lost_ = true;
    }
    if (kept_.empty()) {
        return;
    }
    driver.doubt_position(kept_, kept_lost_); // what happened tells more than how the controller was found
}

void PositionMemory::keep(const drivers::DriverStatus& status) {
    const bool runs = drivers::is_at_work(status.state) && (status.activity == drivers::Activity::program ||
                                                            status.activity == drivers::Activity::command);
    const bool moving = runs || (status.link_lost && kept_moving_);
    if (status.state == drivers::DriverState::disconnected ||
        (status.position_doubt == kept_ && status.position_lost == kept_lost_ && moving == kept_moving_)) {
        return;
    }
    kept_ = status.position_doubt;
    kept_lost_ = status.position_lost;
    kept_moving_ = moving;
    if (kept_.empty() && !moving) {
        std::error_code why;
        std::filesystem::remove(file_, why);
        if (why) {
            throw Error("cannot remove the file: " + why.message(), file_);
        }
    } else {
        const nlohmann::ordered_json whole{{"format", position_doubt_format_name},
                                           {"version", position_doubt_format_version},
                                           {"controller", controller_},
                                           {"doubt", kept_},
                                           {"lost", kept_lost_},
                                           {"moving", kept_moving_}};
        make_folder(std::filesystem::absolute(folder_));
        write_file(file_, whole.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
    }
}

} // namespace millwright::jobs
