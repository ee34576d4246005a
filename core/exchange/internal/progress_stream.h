// A text that is read as a stream, and tells how far.
#pragma once

#include "core/base/progress.h"

#include <streambuf>
#include <string>

namespace millwright::exchange {

/// `text` must outlive it. `afterwards`: what is being done once all of it is given.
class ProgressStream final : public std::streambuf {
public:
    ProgressStream(const std::string& text, Progress progress, std::string afterwards);

protected:
    int_type underflow() override;

private:
    const std::string& text_;
    Progress progress_;
    std::string afterwards_;
    std::size_t given_ = 0;
};

} // namespace millwright::exchange
