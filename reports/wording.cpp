#include "reports/wording.h"

#include "gum/quantity/diagnostic.h"
#include "reports/record/canonical_json.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>

namespace gumcert::reports {

namespace {

[[noreturn]] void refuse(const std::string& pointer, const std::string& what) {
    throw gum::StorageError(gum::Diagnostic{.code = "GC-REPORT-0001",
                                            .where = "wording#" + pointer,
                                            .what = what,
                                            .rule = "every text of a document is in the wording file",
                                            .action = "take the templates of this release"});
}

std::string text_at(const nlohmann::json& texts, const std::string& pointer) {
    const nlohmann::json::json_pointer at(pointer);
    if (!texts.contains(at) || !texts.at(at).is_string()) {
        refuse(pointer, "missing");
    }
    return texts.at(at).get<std::string>();
}

}  // namespace

std::string Wording::language() const {
    return text_at(texts_, "/language");
}

std::string Wording::operator()(const std::string& group, const std::string& name) const {
    return text_at(texts_, "/" + group + "/" + name);
}

std::string Wording::operator()(const std::string& group, const std::string& name, const std::string& item) const {
    return text_at(texts_, "/" + group + "/" + name + "/" + pointer_token(item));
}

std::string Wording::filled(const std::string& group, const std::string& name, const Values& values) const {
    const std::string text = (*this)(group, name);
    std::string out;
    std::size_t at = 0;
    while (at < text.size()) {
        const std::size_t open = text.find('{', at);
        const std::size_t close = open == std::string::npos ? open : text.find('}', open);
        if (close == std::string::npos) {
            return out + text.substr(at);
        }
        const std::string key = text.substr(open + 1, close - open - 1);
        const auto value = std::find_if(values.begin(), values.end(), [&](const auto& v) { return v.first == key; });
        if (value == values.end()) {
            refuse("/" + group + "/" + name, "names a value {" + key + "} that does not exist");
        }
        out += text.substr(at, open - at) + value->second;
        at = close + 1;
    }
    return out;
}

}  // namespace gumcert::reports
