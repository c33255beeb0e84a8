#include "reports/comparison_identity.h"

#include <nlohmann/json.hpp>

#include <utility>
#include <vector>

namespace gumcert::reports {

namespace {

using nlohmann::json;

std::string text_at(const json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

/// A text of certificate data: one for all languages, or an object with one a language.
Text localised_at(const json& object, const char* key, const Wording& words) {
    const auto found = object.find(key);
    if (found == object.end() || (!found->is_string() && !found->is_object())) {
        return {};
    }
    if (found->is_string()) {
        return found->get<std::string>();
    }
    std::vector<std::string> texts;
    for (const std::string& language : words.languages()) {
        std::string text = text_at(*found, language.c_str());
        for (auto other = found->begin(); text.empty() && other != found->end(); ++other) {
            text = other->is_string() ? other->get<std::string>() : "";
        }
        texts.push_back(std::move(text));
    }
    return Text(texts);
}

const json& object_at(const json& object, const char* key) {
    static const json k_nothing = json::object();
    const auto found = object.find(key);
    return found != object.end() && found->is_object() ? *found : k_nothing;
}

}  // namespace

ComparisonIdentity comparison_identity(const EvaluationRecord& record, const Wording& words) {
    if (record.certificate) {
        const certificate::CertificateData& data = record.certificate->data;
        return {
            .laboratory = words.localised(data.laboratory.name), .number = data.number, .issued = data.dates.issued};
    }
    const json job = json::parse(record.job_json, nullptr, false);
    if (!job.is_object()) {
        return {};
    }
    const json& data = object_at(job, "certificate");
    return {.laboratory = localised_at(object_at(data, "laboratory"), "name", words),
            .number = text_at(data, "number"),
            .issued = text_at(object_at(data, "dates"), "issued")};
}

}  // namespace gumcert::reports
