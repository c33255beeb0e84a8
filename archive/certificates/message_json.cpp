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

}  // namespace gumcert::archive
