// Loaded into a program (LD_PRELOAD): kills it, as kill -9 does, right after its call number
// MILLWRIGHT_KILL_AT that changes the name of a file.
#include <dlfcn.h>
#include <sys/types.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdlib>

namespace {

template <class Function> Function* original(const char* name) {
    return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

int counted(int result) {
    static std::atomic<int> calls = 0;
    const char* const last = std::getenv("MILLWRIGHT_KILL_AT");
    if (last != nullptr && ++calls == std::atoi(last)) {
        ::kill(::getpid(), SIGKILL);
    }
    return result;
}

} // namespace

extern "C" {

int rename(const char* from, const char* to) noexcept {
    return counted(original<int(const char*, const char*)>("rename")(from, to));
}

int renameat2(int folder, const char* from, int to_folder, const char* to, unsigned flags) noexcept {
    return counted(original<int(int, const char*, int, const char*, unsigned)>("renameat2")(
        folder, from, to_folder, to, flags));
}

int link(const char* from, const char* to) noexcept {
    return counted(original<int(const char*, const char*)>("link")(from, to));
}

int unlink(const char* file) noexcept {
    return counted(original<int(const char*)>("unlink")(file));
}

int remove(const char* file) noexcept {
    return counted(original<int(const char*)>("remove")(file));
}
}
