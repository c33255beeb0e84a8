#include "archive/certificates/message_json.h"

#include <nlohmann/json.hpp>

namespace gumcert::archive {

nlohmann::json as_json(const gum::Diagnostic& diagnostic) {
    return {{"code", diagnostic.code},
            {"where", diagnostic.where},
            {"what", diagnostic.what},
            {"rule", diagnostic.rule},
            {"action", diagnostic.action}};
}

nlohmann::json as_json(const std::vector<gum::Diagnostic>& diagnostics) {
    nlohmann::json list = nlohmann::json::array();
    for (const gum::Diagnostic& one : diagnostics) {
        list.push_back(as_json(one));
    }
    return list;
}

}  // namespace gumcert::archive
