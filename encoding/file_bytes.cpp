#include "encoding/file_bytes.h"

#include <fcntl.h>
#include <linux/openat2.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <system_error>
#include <utility>

namespace gumcert::encoding {

namespace {

std::string reason(int error) {
    return error == ENOENT  ? "there is no such file"
           : error == EXDEV ? "its name leads out of its folder, by .. or by a symbolic link"
                            : std::generic_category().message(error);
}

std::string kind_objection(const struct stat& status) {
    return S_ISREG(status.st_mode) ? "" : S_ISDIR(status.st_mode) ? "it is a folder" : "it is not a regular file";
}

class Descriptor {
public:
    explicit Descriptor(int value) : value_(value) {}
    Descriptor(Descriptor&& other) noexcept : value_(std::exchange(other.value_, -1)) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() {
        if (value_ >= 0) {
            close(value_);
        }
    }
    [[nodiscard]] int value() const { return value_; }

private:
    int value_;
};

/// \return the number of a descriptor; -1 with errno EXDEV where the name leads out of the folder
int open_step_by_step(int folder, const std::filesystem::path& name, int flags) {
    constexpr int k_most_links = 40;  // as Linux
    std::deque<std::filesystem::path> rest(name.begin(), name.end());
    std::deque<Descriptor> folders;  // from the first one downwards
    const auto here = [&] { return folders.empty() ? folder : folders.back().value(); };
    int links = 0;
    if (name.empty() || name.is_absolute()) {
        errno = name.empty() ? ENOENT : EXDEV;
        return -1;
    }
    while (!rest.empty()) {
        const std::filesystem::path part = std::move(rest.front());
        rest.pop_front();
        if (part.empty() || part == ".") {
            continue;
        }
        if (part == "..") {
            if (folders.empty()) {
                errno = EXDEV;
                return -1;
            }
            folders.pop_back();
            continue;
        }
        Descriptor next(openat(here(), part.c_str(), O_PATH | O_NOFOLLOW | O_CLOEXEC));
        struct stat status = {};
        if (next.value() < 0 || fstat(next.value(), &status) != 0) {
            return -1;
        }
        if (S_ISLNK(status.st_mode)) {
            std::array<char, PATH_MAX> target{};
            const ssize_t length = readlinkat(next.value(), "", target.data(), target.size());
            if (length < 0 || ++links > k_most_links) {
                errno = length < 0 ? errno : ELOOP;
                return -1;
            }
            const std::filesystem::path to(std::string(target.data(), static_cast<std::size_t>(length)));
            if (to.is_absolute()) {
                errno = EXDEV;
                return -1;
            }
            rest.insert(rest.begin(), to.begin(), to.end());
            continue;
        }
        if (rest.empty()) {
            return openat(here(), part.c_str(), flags | O_NOFOLLOW);
        }
        if (!S_ISDIR(status.st_mode)) {
            errno = ENOTDIR;
            return -1;
        }
        folders.emplace_back(std::move(next));
    }
    return openat(here(), ".", flags);
}

int open_beneath(int folder, const std::filesystem::path& name, int flags, Walk walk) {
    if (walk == Walk::by_kernel) {
        constexpr int k_attempts = 10;  // the kernel gives up where parts of the name are exchanged just now
        open_how how{};
        how.flags = static_cast<unsigned>(flags);
        how.resolve = RESOLVE_BENEATH | RESOLVE_NO_MAGICLINKS;
        for (int i = 0; i < k_attempts; ++i) {
            const long opened = syscall(SYS_openat2, folder, name.c_str(), &how, sizeof(how));
            if (opened >= 0 || (errno != EAGAIN && errno != ENOSYS && errno != EPERM)) {
                return static_cast<int>(opened);
            }
        }
    }
    return open_step_by_step(folder, name, flags);
}

/// \param open_file  opens the file with these flags, and gives the number of its descriptor or -1
FileBytes read_by(const std::function<int(int flags)>& open_file, std::size_t most) {
    FileBytes result;
    struct stat status = {};
    // Before it is opened for reading: that alone can wait, or wake a device.
    const Descriptor place(open_file(O_PATH | O_CLOEXEC));
    if (place.value() < 0 || fstat(place.value(), &status) != 0) {
        result.leads_out = errno == EXDEV;
        result.failure = reason(errno);
        return result;
    }
    result.failure = kind_objection(status);
    if (!result.failure.empty()) {
        return result;
    }
    const Descriptor descriptor(open_file(O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
    if (descriptor.value() < 0) {
        result.failure = reason(errno);
        return result;
    }
    if (fstat(descriptor.value(), &status) != 0) {
        result.failure = reason(errno);
        return result;
    }
    result.failure = kind_objection(status);  // it may have been exchanged meanwhile
    if (!result.failure.empty()) {
        return result;
    }
    result.mode = static_cast<unsigned>(status.st_mode) & 0777U;
    const auto stated = static_cast<std::uintmax_t>(std::max<off_t>(status.st_size, 0));
    result.bytes.resize(static_cast<std::size_t>(std::min<std::uintmax_t>(stated, most)) + 1);
    std::size_t size = 0;
    for (;;) {
        const ssize_t count = read(descriptor.value(), result.bytes.data() + size, result.bytes.size() - size);
        if (count < 0 && errno == EINTR) {
            continue;
        }
        if (count < 0) {
            result.failure = "reading failed: " + reason(errno);
            result.bytes.clear();
            return result;
        }
        if (count == 0) {
            break;
        }
        size += static_cast<std::size_t>(count);
        if (size > most) {
            result.too_long = true;
            break;
        }
        if (size == result.bytes.size()) {
            result.bytes.resize(std::min(2 * size, most + 1));  // it grew, or does not state its size
        }
    }
    result.bytes.resize(std::min(size, most));
    return result;
}

}  // namespace

FileBytes read_regular_file(const std::filesystem::path& file, std::size_t most) {
    return read_by([&](int flags) { return open(file.c_str(), flags); }, most);
}

FileBytes read_file_beneath(const std::filesystem::path& folder, const std::filesystem::path& name, std::size_t most,
                            Walk walk) {
    const Descriptor opened(open(folder.empty() ? "." : folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
    if (opened.value() < 0) {
        FileBytes result;
        result.failure = reason(errno);
        return result;
    }
    return read_by([&](int flags) { return open_beneath(opened.value(), name, flags, walk); }, most);
}

std::vector<std::string> json_files_in(const std::filesystem::path& folder) {
    std::vector<std::string> names;
    std::error_code error;
    for (const std::filesystem::directory_entry& entry : std::filesystem::directory_iterator(folder, error)) {
        if (entry.path().extension() == ".json") {
            names.push_back(entry.path().stem().string());
        }
    }
    std::sort(names.begin(), names.end());
    return names;
}

}  // namespace gumcert::encoding
