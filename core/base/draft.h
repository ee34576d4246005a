// A file in the making, beside the file whose place it is to take.
#pragma once

#include <filesystem>
#include <string_view>

namespace millwright {

/// Who may read a file that was not there before.
enum class Privacy { shared, own }; ///< as the umask says; the user only

/// Has a random name, is made by no one else and never through a link. It is locked while it lives: one that
/// a killed program has left is removed when the next is made in its folder. All members throw Error with the
/// file that is to be written and the system's reason.
class Draft {
public:
    /// Refuses a `target` that is a folder, that the user may not write, that is write-protected, even for
    /// root, and one behind a link, also of a folder, that a stranger may have put into a folder in which
    /// others may write. Behind any other link the link's target is meant.
    explicit Draft(const std::filesystem::path& target, Privacy privacy = Privacy::shared);
    Draft(const Draft&) = delete;
    Draft& operator=(const Draft&) = delete;
    ~Draft(); ///< removes what is left: itself, or the old file

    [[nodiscard]] const std::filesystem::path& target() const { return target_; }

    void write(std::string_view bytes);
    /// Puts the file in its place, with owner and rights of the old one. Nothing may be written then.
    void finish();

    /// The same, but the old file lives on until the end of this, so that it can be put back. Who kills us
    /// before that ends it, too: what is to stay has another name by then.
    void exchange();
    void put_back();

private:
    void make();
    void take_rights();
    void take_visible_name();
    void copy_into_place();
    void close();
    [[noreturn]] void fail() const;

    std::filesystem::path target_;
    Privacy privacy_;
    std::filesystem::path place_; ///< empty: it has taken its place
    std::filesystem::path old_;   ///< where the old file is; empty: there is none, or it is in its place
    int handle_ = -1;
    bool replaces_ = false;
    bool owner_is_lost_ = false; ///< a rename would give the file to us
};

} // namespace millwright
