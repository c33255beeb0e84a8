#include "certificate/result_names.h"

#include <algorithm>
#include <cctype>

namespace gumcert::certificate {

bool is_named(const std::vector<std::string>& names, const std::string& result) {
    return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
        return name.ends_with('*') ? result.starts_with(name.substr(0, name.size() - 1)) : result == name;
    });
}

bool is_covered(const std::vector<std::string>& names, const std::string& result) {
    if (is_named(names, result)) {
        return true;
    }
    constexpr std::size_t k_letter = 5;  // of "axis_y"
    return result.size() == k_letter + 1 && result.starts_with("axis_") &&
           std::any_of(names.begin(), names.end(), [&](const std::string& name) {
               return name.size() == 4 && name[0] == 'E' && name[2] == '0' &&
                      std::tolower(static_cast<unsigned char>(name[1])) == result[k_letter];
           });
}

}  // namespace gumcert::certificate
