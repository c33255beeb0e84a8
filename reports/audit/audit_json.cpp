#include "reports/audit/audit_json.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "json/canonical_json.h"

namespace gumcert::reports {
namespace {

using nlohmann::json;

json number(double value) {
    return std::isfinite(value) ? json(value) : json();
}

json number(const std::optional<double>& value) {
    return value ? number(*value) : json();
}

json text_or_null(const std::string& text) {
    return text.empty() ? json() : json(text);
}

/// What follows from a budget, without its value.
json outcome(const PrintedOutcome& printed) {
    return {{"u_c", number(printed.number.u_c)},
            {"nu_eff", number(printed.number.nu_eff)},
            {"k", number(printed.number.k)},
            {"U", number(printed.number.U)},
            {"verdict", text_or_null(printed.verdict)}};
}

json outcome_with_value(const PrintedOutcome& printed) {
    json all = outcome(printed);
    all["value"] = number(printed.number.value);
    if (printed.number.en) {
        all["En"] = number(printed.number.en);
    }
    return all;
}

json outcome_with_score(const PrintedOutcome& printed) {
    json all = outcome(printed);
    all["En"] = number(printed.number.en);
    return all;
}

json interval(const PrintedInterval& printed) {
    return {{"low", number(printed.number.low)}, {"high", number(printed.number.high)}};
}

json finding(const AuditFindingView& one, const AuditedFileView& file, const AuditView& view) {
    json names = json::array();
    for (const std::size_t result : one.results) {
        names.push_back(file.results[result].name);
    }
    json entry = {{"id", one.id},
                  {"title", one.title},
                  {"severity", one.severity},
                  {"clause", one.clause},
                  {"clause_verified", one.clause_verified},
                  {"where", one.where},
                  {"what", one.what},
                  {"evidence", one.evidence},
                  {"expected", text_or_null(one.expected)},
                  {"actual", text_or_null(one.actual)},
                  {"correction", one.correction},
                  {"question", one.question},
                  {"results", std::move(names)},
                  {"effect", nullptr},
                  {"effect_on", nullptr}};
    if (one.effect) {
        entry["effect"] = {{"alone", outcome_with_score(one.effect->alone)},
                           {"last", outcome_with_score(one.effect->last)},
                           {"share", number(one.effect->share)}};
        entry["effect_on"] = file.results[one.effect->result].name;
    }
    if (one.missing_term) {
        entry["missing_term"] = {{"u_for_digit", number(one.missing_term->number.u_for_digit)},
                                 {"u_for_verdict", number(one.missing_term->number.u_for_verdict)}};
    }
    if (one.waiver) {
        const PrintedWaiver& waiver = view.waivers[*one.waiver];
        entry["waiver"] = {{"by", waiver.by}, {"when", waiver.when}, {"reason", waiver.reason}};
    }
    return entry;
}

json file_json(const AuditedFileView& file, const AuditView& view) {
    json all = {{"file", file.name},         {"kind", file.kind},
                {"claimed", nullptr},        {"recomputed", nullptr},
                {"audited", nullptr},        {"results", json::array()},
                {"findings", json::array()}, {"not_checked", json::array()},
                {"not_read", file.not_read}};
    if (!file.sha256.empty()) {
        all["sha256"] = file.sha256;
    }
    for (const AuditedResultView& result : file.results) {
        all["results"].push_back({{"name", result.name},
                                  {"unit", result.unit},
                                  {"claimed", outcome_with_value(result.claimed)},
                                  {"recomputed", outcome_with_value(result.recomputed)},
                                  {"audited", outcome_with_value(result.audited)},
                                  {"allowed",
                                   {{"u_c", interval(result.u_c)},
                                    {"nu_eff", interval(result.nu_eff)},
                                    {"k", interval(result.k)},
                                    {"U", interval(result.U)}}}});
    }
    if (!file.results.empty()) {
        const json& worst = all["results"][file.worst];
        for (const char* key : {"claimed", "recomputed", "audited"}) {
            all[key] = worst.at(key);
        }
        all["result"] = worst.at("name");
    }
    for (const AuditFindingView& one : file.findings) {
        all["findings"].push_back(finding(one, file, view));
    }
    for (const NotCheckedView& one : file.not_checked) {
        all["not_checked"].push_back({{"id", one.id}, {"because", one.because}});
    }
    return all;
}

}  // namespace

std::string audit_as_json(const AuditView& view) {
    json files = json::array();
    for (const AuditedFileView& file : view.files) {
        files.push_back(file_json(file, view));
    }
    json all = files.empty() ? json::object() : files[view.worst];
    all["schema"] = "gumcert/audit/1";
    all["program"] = view.program;
    if (files.size() > 1) {
        all["files"] = std::move(files);
    }
    return gumcert::json::canonical_json(all);
}

}  // namespace gumcert::reports
