#include "tests/ui/render/file_manager.h"

#include "core/base/error.h"

#include <X11/Xlib.h>
#include <X11/Xutil.h>

#include <algorithm>
#include <array>
#include <vector>

namespace millwright::test {

struct FileManager::Parts {
    Parts() : display_(XOpenDisplay(nullptr)) {
        expects(display_ != nullptr, "the display answers a second program");
        root_ = DefaultRootWindow(display_);
        self_ = XCreateSimpleWindow(display_, root_, 0, 0, 1, 1, 0, 0, 0);
        XSetSelectionOwner(display_, atom("XdndSelection"), self_, CurrentTime);
    }
    Parts(const Parts&) = delete;
    Parts& operator=(const Parts&) = delete;
    ~Parts() { XCloseDisplay(display_); }

    void drop(const std::string& title, const std::string& uris) {
        uris_ = uris;
        target_ = window_called(title, root_);
        expects(target_ != None, "the window is there");
        constexpr long version = 5L << 24;
        const auto self = static_cast<long>(self_);
        say("XdndEnter", {self, version, static_cast<long>(atom("text/uri-list")), 0, 0});
        say("XdndPosition", {self, 0, 0, CurrentTime, static_cast<long>(atom("XdndActionCopy"))});
        say("XdndDrop", {self, 0, CurrentTime, 0, 0});
    }

    bool answers_until_taken() {
        while (XPending(display_) > 0) {
            XEvent event;
            XNextEvent(display_, &event);
            if (event.type == SelectionRequest) {
                hand_over(event.xselectionrequest);
            }
            taken_ =
                taken_ || (event.type == ClientMessage && event.xclient.message_type == atom("XdndFinished"));
        }
        return taken_;
    }

    Atom atom(const char* name) { return XInternAtom(display_, name, False); }

    Window window_called(const std::string& title, Window above) {
        Window root = None;
        Window parent = None;
        Window* below = nullptr;
        unsigned int count = 0;
        XQueryTree(display_, above, &root, &parent, &below, &count);
        const std::vector<Window> children(below, below + count);
        XFree(below);
        for (const Window child : children) {
            char* name = nullptr;
            const bool is_it = XFetchName(display_, child, &name) != 0 && title == name;
            XFree(name);
            const Window found = is_it ? child : window_called(title, child);
            if (found != None) {
                return found;
            }
        }
        return None;
    }

    void say(const char* message, const std::array<long, 5>& words) {
        XEvent event = {};
        event.xclient.type = ClientMessage;
        event.xclient.window = target_;
        event.xclient.message_type = atom(message);
        event.xclient.format = 32;
        std::ranges::copy(words, event.xclient.data.l);
        XSendEvent(display_, target_, False, NoEventMask, &event);
        XFlush(display_);
    }

    void hand_over(const XSelectionRequestEvent& asked) {
        XChangeProperty(display_,
                        asked.requestor,
                        asked.property,
                        asked.target,
                        8,
                        PropModeReplace,
                        reinterpret_cast<const unsigned char*>(uris_.data()),
                        static_cast<int>(uris_.size()));
        XEvent event = {};
        event.xselection.type = SelectionNotify;
        event.xselection.requestor = asked.requestor;
        event.xselection.selection = asked.selection;
        event.xselection.target = asked.target;
        event.xselection.property = asked.property;
        event.xselection.time = asked.time;
        XSendEvent(display_, asked.requestor, False, NoEventMask, &event);
        XFlush(display_);
    }

    Display* display_;
    Window root_ = None;
    Window self_ = None;
    Window target_ = None;
    std::string uris_;
    bool taken_ = false;
};

FileManager::FileManager() : parts_(std::make_unique<Parts>()) {}

FileManager::~FileManager() = default;

void FileManager::drop(const std::string& title, const std::string& uris) {
    parts_->drop(title, uris);
}

bool FileManager::answers_until_taken() {
    return parts_->answers_until_taken();
}

} // namespace millwright::test
