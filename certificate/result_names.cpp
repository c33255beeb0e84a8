#include "certificate/result_names.h"

#include <algorithm>

namespace gumcert::certificate {

bool is_named(const std::vector<std::string>& names, const std::string& result) {
    return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
        return name.ends_with('*') ? result.starts_with(name.substr(0, name.size() - 1)) : result == name;
    });
}

}  // namespace gumcert::certificate
