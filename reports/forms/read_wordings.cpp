#include "reports/forms/read_wordings.h"

namespace gumcert::reports {

Wording ReadWordings::find_or_read(const std::vector<std::string>& key, const std::function<Wording()>& read) {
    const std::lock_guard lock(one_at_a_time_);
    auto found = by_key_.find(key);
    if (found == by_key_.end()) {
        found = by_key_.emplace(key, read()).first;
    }
    return found->second;
}

}  // namespace gumcert::reports
