// Processor time, for comparing programs on a machine that has other things to do.
#pragma once

#include <sys/resource.h>

namespace millwright {

/// s so far, in user and system mode, of `who`: RUSAGE_SELF, or RUSAGE_CHILDREN that have ended.
inline double processor_time(int who) {
    rusage usage{};
    getrusage(who, &usage);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

} // namespace millwright
