#include "ui/workspaces/approach.h"

#include <utility>

namespace millwright::actions {

namespace {

/// What stands above the line, without the empty lines that keep the numbers.
std::vector<std::string> lines_before(const jobs::Job& job) {
    std::vector<std::string> lines;
    const std::string& text = job.listing->text;
    for (std::size_t at = 0; at < text.size() && text[at] != '\n';) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        lines.push_back(text.substr(at, end - at));
        at = end + 1;
    }
    return lines;
}

} // namespace

Approach approach_for(const ApproachWish& wish) {
    Approach answer{wish, std::nullopt, {}, std::nullopt};
    try {
        const jobs::Job whole = make_job(wish.source);
        if (!wish.begin.hash.empty() && jobs::program_hash(whole.listing->text) != wish.begin.hash) {
            throw Error("the program has changed since the job was interrupted",
                        {},
                        "run it from the beginning, or choose the line yourself");
        }
        jobs::RunFromSettings settings;
        settings.dialect = wish.dialect;
        settings.clearance = wish.begin.clearance;
        jobs::Job job = jobs::job_from_line(whole, wish.begin.line, settings);
        answer.lines = lines_before(job);
        answer.job = std::move(job);
    } catch (const Error& error) {
        answer.refusal = error.diagnostic();
    }
    return answer;
}

void ApproachFinder::want(std::optional<ApproachWish> wish) {
    if (wish == wish_) {
        return;
    }
    wish_ = std::move(wish);
    if (wish_) {
        work_.want(*wish_);
    } else {
        work_.forget();
    }
}

std::shared_ptr<const Approach> ApproachFinder::answer() const {
    auto found = work_.answer();
    return found && wish_ && found->wish == *wish_ ? found : nullptr;
}

} // namespace millwright::actions
