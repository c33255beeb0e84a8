#include "reports/audit/audit_json.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>
#include <vector>

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
                  {"what", one.what.english()},
                  {"evidence", english_of(one.evidence)},
                  {"expected", text_or_null(one.expected.english())},
                  {"actual", text_or_null(one.actual.english())},
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
    if (one.effect_on_score) {
        const EffectView& effect = *one.effect_on_score;
        entry["effect_on_score"] = {{"result", file.results[effect.result].name},
                                    {"alone", outcome_with_score(effect.alone)},
                                    {"last", outcome_with_score(effect.last)},
                                    {"share", number(effect.share)}};
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
    json all = {{"file", file.name},
                {"kind", file.kind},
                {"claimed", nullptr},
                {"recomputed", nullptr},
                {"audited", nullptr},
                {"results", json::array()},
                {"findings", json::array()},
                {"not_checked", json::array()},
                {"not_read", english_of(file.not_read)}};
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
        if (result.sampled_shares) {
            all["results"].back()["sampled_shares"] = true;
        }
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
        all["not_checked"].push_back({{"id", one.id}, {"because", one.because.english()}});
    }
    return all;
}

const char* name_of(UnauditedFile::Kind kind) {
    switch (kind) {
        case UnauditedFile::Kind::refused:
            return "refused";
        case UnauditedFile::Kind::in_record:
            return "in_record";
        case UnauditedFile::Kind::other_kind:
            return "other_kind";
    }
    return "";
}

/// The text of one file as it stands in the array of all: two blanks deeper, without LF at its end.
std::string text_in_array(const json& file) {
    const std::string own = gumcert::json::canonical_json(file);
    std::string text;
    text.reserve(own.size() + own.size() / 4);
    for (std::size_t at = 0; at < own.size();) {
        const std::size_t end = std::min(own.find('\n', at), own.size());
        text += at == 0 ? "  " : "\n  ";
        text.append(own, at, end - at);
        at = end + 1;
    }
    return text;
}

}  // namespace

std::string audit_as_json(const AuditView& view, const TaskRunner& run) {
    json all = view.files.empty() ? json::object() : file_json(view.files[view.worst], view);
    all["schema"] = "gumcert/audit/1";
    all["program"] = view.program;
    for (const UnauditedFile& one : view.unaudited) {
        all["unaudited"].push_back(
            {{"file", one.file}, {"why", name_of(one.kind)}, {"because", text_or_null(one.because)}});
    }
    if (view.files.size() < 2) {
        return gumcert::json::canonical_json(all);
    }
    // The files of a folder are written one by one: together as one value they would take many times their text.
    std::vector<std::string> texts(view.files.size());
    run_tasks(run, texts.size(), [&](std::size_t i) { texts[i] = text_in_array(file_json(view.files[i], view)); });
    constexpr std::string_view k_key = "\n \"files\": ", k_nothing = "null";  // keys of the top alone have one blank
    all["files"] = nullptr;
    std::string text = gumcert::json::canonical_json(all);
    const std::size_t at = text.find(k_key) + k_key.size();
    const std::string behind = text.substr(at + k_nothing.size());
    text.resize(at);
    std::size_t size = text.size() + behind.size();
    for (const std::string& one : texts) {
        size += one.size() + 2;
    }
    text.reserve(size + 8);
    text += "[";
    for (std::size_t i = 0; i < texts.size(); ++i) {
        text += i == 0 ? "\n" : ",\n";
        text += texts[i];
    }
    text += "\n ]" + behind;
    return text;
}

}  // namespace gumcert::reports
