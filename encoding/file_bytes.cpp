#include "encoding/file_bytes.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <system_error>

namespace gumcert::encoding {

namespace {

std::string reason(int error) {
    return error == ENOENT ? "there is no such file" : std::generic_category().message(error);
}

std::string kind_objection(const struct stat& status) {
    return S_ISREG(status.st_mode) ? "" : S_ISDIR(status.st_mode) ? "it is a folder" : "it is not a regular file";
}

class Descriptor {
public:
    explicit Descriptor(int value) : value_(value) {}
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

}  // namespace

FileBytes read_regular_file(const std::filesystem::path& file, std::size_t most) {
    FileBytes result;
    struct stat status = {};
    // Before it is opened: opening alone can wait, or wake a device.
    if (stat(file.c_str(), &status) != 0) {
        result.failure = reason(errno);
        return result;
    }
    result.failure = kind_objection(status);
    if (!result.failure.empty()) {
        return result;
    }
    const Descriptor descriptor(open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
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

}  // namespace gumcert::encoding
