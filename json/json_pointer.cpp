#include "json/json_pointer.h"

namespace gumcert::json {

std::string pointer_token(std::string_view key) {
    std::string token;
    for (const char c : key) {
        if (c == '~') {
            token += "~0";
        } else if (c == '/') {
            token += "~1";
        } else {
            token += c;
        }
    }
    return token;
}

std::string child_pointer(const std::string& pointer, std::string_view key) {
    return pointer + '/' + pointer_token(key);
}

std::string child_pointer(const std::string& pointer, std::size_t index) {
    return pointer + '/' + std::to_string(index);
}

std::string_view parent_pointer(std::string_view pointer) {
    return pointer.substr(0, pointer.empty() ? 0 : pointer.rfind('/'));
}

}  // namespace gumcert::json
