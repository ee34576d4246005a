// The places of a set-up search on all ranks: place n on rank n % size. The costs are those of one process,
// to the bit.
#pragma once

#include "app/studies/ranks.h"
#include "core/base/progress.h"
#include "core/toolpath/set_up_search.h"

#include <functional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

namespace millwright::app {

/// At rank 0, while the others are in help_with_costs() with the same cost.
class SpreadCosts {
public:
    /// `say` is called for ranks that failed or went, with a sentence each that names their places.
    SpreadCosts(const Ranks& ranks,
                const toolpath::SetUpCost& cost,
                std::function<void(const std::string&)> say);
    SpreadCosts(const SpreadCosts&) = delete;
    SpreadCosts& operator=(const SpreadCosts&) = delete;
    ~SpreadCosts() = default;

    /// As toolpath::SetUpCosts. Throws Error if costs did not come; Cancelled.
    [[nodiscard]] std::vector<toolpath::PlaceFigures> at(std::span<const toolpath::SetUpPlace> places,
                                                         const Progress& progress);

private:
    const Ranks& ranks_;
    const toolpath::SetUpCost& cost_;
    std::function<void(const std::string&)> say_;
};

/// At the others, until rank 0 lets them go. Where rank 0 is gone `deserted` is called with a sentence, by
/// the caller's thread, that names the places of this rank that are lost.
void help_with_costs(const Ranks& ranks,
                     const toolpath::SetUpCost& cost,
                     const std::function<void(const std::string& lost)>& deserted,
                     const std::stop_token& stop);

} // namespace millwright::app
