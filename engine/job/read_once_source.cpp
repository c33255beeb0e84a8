#include "engine/job/read_once_source.h"

#include "encoding/sha2.h"

namespace gumcert::engine {

std::string ReadOnceSource::read(const std::string& name) const {
    const std::lock_guard guard(lock_);
    const auto found = read_.find(name);
    return found != read_.end() ? found->second : read_.emplace(name, source_.read(name)).first->second;
}

std::string ReadOnceSource::digest(const std::string& name) const {
    return encoding::sha256(read(name));
}

}  // namespace gumcert::engine
