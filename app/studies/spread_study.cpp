#include "app/studies/spread_study.h"

#include "app/studies/mpi_gather.h"
#include "app/studies/study_message.h"
#include "app/studies/unfinished_study.h"
#include "core/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <numeric>
#include <optional>
#include <stop_token>
#include <utility>

namespace millwright::app {

namespace {

using studies::StudyCase;
using studies::StudyRow;

/// The cases of one rank, one after another; every one is reported, and the end in any case.
void study_cases(const Ranks& ranks,
                 std::span<const StudyCase> cases,
                 const StudyOne& study,
                 const Tell& tell_bytes,
                 const std::stop_token& stop) {
    const auto tell = [&](const StudyMessage& message) { tell_bytes(packed(message)); };
    constexpr std::chrono::milliseconds between_reports{200};
    auto last = std::chrono::steady_clock::now();
    StudyMessage end{.ended = true};
    try {
        for (std::size_t n = static_cast<std::size_t>(ranks.rank()); n < cases.size();
             n += static_cast<std::size_t>(ranks.size())) {
            const auto report = [&, n](const Progress::Report& now) {
                if (std::chrono::steady_clock::now() - last > between_reports) {
                    last = std::chrono::steady_clock::now();
                    tell({.at = n, .fraction = now.fraction, .text = now.text});
                }
            };
            tell({.at = n, .fraction = 1.0, .rows = study(cases[n], Progress(report, stop))});
        }
    } catch (const Cancelled&) {
        end.text = "stopped";
    } catch (const std::exception& failure) {
        end.text = failure.what();
        end.failed = true;
    }
    tell(end);
}

/// Where all ranks are.
class Gathering {
public:
    Gathering(int ranks, std::span<const StudyCase> cases)
        : cases_(cases), ranks_(static_cast<std::size_t>(ranks)), fractions_(cases.size(), 0.0) {
        study_.rows.resize(cases.size());
    }

    /// Whether a case is done with it.
    bool take(int from, StudyMessage message) {
        Rank& rank = ranks_[static_cast<std::size_t>(from)];
        rank.ended = rank.ended || message.ended;
        if (message.failed) {
            rank.why = message.text;
        }
        if (message.at) {
            fractions_.at(*message.at) = message.fraction;
        }
        if (message.rows) {
            study_.rows.at(*message.at) = std::move(*message.rows);
        }
        return message.rows.has_value();
    }
    [[nodiscard]] bool over() const { return std::ranges::all_of(ranks_, &Rank::ended); }
    [[nodiscard]] double fraction() const {
        return std::accumulate(fractions_.begin(), fractions_.end(), 0.0) /
               static_cast<double>(cases_.size());
    }
    [[nodiscard]] const std::vector<std::vector<StudyRow>>& rows() const { return study_.rows; }

    /// What is lost by one rank, as a sentence; nothing if all of its cases have come.
    [[nodiscard]] std::optional<std::string> lost_by(std::size_t rank) const {
        std::string missing;
        for (std::size_t n = rank; n < cases_.size(); n += ranks_.size()) {
            if (study_.rows[n].empty()) {
                missing += (missing.empty() ? "" : ", ") + name_of(cases_[n]);
            }
        }
        if (missing.empty()) {
            return std::nullopt;
        }
        return fmt::format("rank {} {}; missing cases: {}", rank, fate(ranks_[rank]), missing);
    }
    /// Notes and tells what is lost by the ranks from `first` on that was not reported before.
    void tell_lost(std::size_t first, const StudyNews& news) {
        for (std::size_t rank = first; rank < ranks_.size(); ++rank) {
            const auto sentence = ranks_[rank].told ? std::nullopt : lost_by(rank);
            if (sentence) {
                ranks_[rank].told = true;
                study_.lost.push_back(*sentence);
                news.lost(*sentence);
            }
        }
    }
    [[nodiscard]] SpreadStudy result() && { return std::move(study_); }

private:
    struct Rank {
        bool ended = false;
        std::string why; ///< it failed
        bool told = false;
    };

    static std::string fate(const Rank& rank) {
        if (!rank.why.empty()) {
            return "failed: " + rank.why;
        }
        return rank.ended ? "was stopped" : "has not ended";
    }

    std::span<const StudyCase> cases_;
    std::vector<Rank> ranks_;
    std::vector<double> fractions_;
    SpreadStudy study_;
};

/// Where a rank is in its cases.
struct Place {
    std::atomic<std::size_t> next;   ///< of all cases
    std::atomic<bool> begun = false; ///< with that one
};

/// Of a rank that has no case to do and none that may be lost: empty.
std::string lost_with_rank_0(const Ranks& ranks, std::span<const StudyCase> cases, const Place& at) {
    const auto step = static_cast<std::size_t>(ranks.size());
    const std::size_t next = at.next;
    std::string missing;
    for (std::size_t n = next; n < cases.size(); n += step) {
        const bool begun = n == next && at.begun;
        missing += (missing.empty() ? "" : ", ") + name_of(cases[n]) + (begun ? " (begun)" : "");
    }
    std::string lost;
    if (!missing.empty()) {
        lost += "; missing cases: " + missing;
    }
    if (next >= step) {
        lost += "; its last finished case may not be written: " + name_of(cases[next - step]);
    }
    return lost.empty()
               ? std::string()
               : fmt::format("rank {} was stopped and rank 0 does not respond{}", ranks.rank(), lost);
}

} // namespace

SpreadStudy gather_study(const Ranks& ranks,
                         std::span<const StudyCase> cases,
                         const StudyOne& study,
                         const StudyNews& news,
                         const Progress& progress) {
    ranks.tell_all("begin");
    Gathering gathering(ranks.size(), cases);
    std::size_t shown = 0;
    const auto over = [&] {
        for (; shown < cases.size() && !gathering.rows()[shown].empty(); ++shown) {
            news.done(gathering.rows()[shown]);
        }
        progress.report(gathering.fraction(), shared_work(cases.size(), "case", ranks));
        return gathering.over();
    };
    const GatheredWork all{
        .own = [&](const Tell& tell,
                   const std::stop_token& stop) { study_cases(ranks, cases, study, tell, stop); },
        .heard =
            [&](int from, const std::string& bytes) {
                if (gathering.take(from, unpacked(bytes))) {
                    news.came(gathering.rows());
                }
            },
        .over = over,
        .given_up = [&] { gathering.tell_lost(1, news); }};
    const bool whole = mpi_gather(ranks, all, progress);
    gathering.tell_lost(0, news);
    SpreadStudy result = std::move(gathering).result();
    result.stopped = !whole;
    return result;
}

void help_with_study(const Ranks& ranks,
                     std::span<const StudyCase> cases,
                     const StudyOne& study,
                     const std::function<void(const std::string& lost)>& deserted,
                     const std::stop_token& stop) {
    Place at{static_cast<std::size_t>(ranks.rank())};
    const auto one = [&](const StudyCase& of, const Progress& progress) {
        at.begun = true;
        std::vector<StudyRow> rows = study(of, progress);
        at.next += static_cast<std::size_t>(ranks.size());
        at.begun = false;
        return rows;
    };
    const HelpingWork mine{.own =
                               [&](const std::string&, const Tell& tell, const std::stop_token& own_stop) {
                                   study_cases(ranks, cases, one, tell, own_stop);
                               },
                           .deserted = [&] { deserted(lost_with_rank_0(ranks, cases, at)); }};
    mpi_help(ranks, mine, stop);
}

} // namespace millwright::app
