#pragma once

#include "reports/wording.h"

#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <vector>

namespace gumcert::reports {

/// The wordings that documents were made with so far. All documents of one command are made with the same words, even
/// where a file of them is changed meanwhile, and a hundred documents read them once. Any thread may ask.
class ReadWordings {
public:
    /// \param key   what a wording depends on: folder, languages, terms
    /// \param read  is called where nobody asked for this key before; nothing is kept if it throws
    [[nodiscard]] Wording find_or_read(const std::vector<std::string>& key, const std::function<Wording()>& read);

private:
    std::mutex one_at_a_time_;
    std::map<std::vector<std::string>, Wording> by_key_;
};

}  // namespace gumcert::reports
