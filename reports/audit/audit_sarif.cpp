#include "reports/audit/audit_sarif.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "json/canonical_json.h"

namespace gumcert::reports {
namespace {

using nlohmann::json;

const char* level_of(std::string_view severity) {
    return severity == "critical" ? "error" : severity == "major" ? "warning" : "note";
}

/// A name as a relative reference (RFC 3986, 2.1 and 3.3): everything but unreserved characters and the slash is
/// percent-encoded, so that no name is taken for a scheme, a query or a fragment.
std::string reference_to(const std::string& name) {
    static constexpr std::string_view k_digits = "0123456789ABCDEF";
    std::string out;
    for (const char c : name) {
        const auto byte = static_cast<unsigned char>(c);
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                           std::string_view("-._~/").find(c) != std::string_view::npos;
        if (plain) {
            out += c;
        } else {
            out += {'%', k_digits[byte >> 4U], k_digits[byte & 0x0FU]};
        }
    }
    return out;
}

json message(const std::string& text) {
    return {{"text", text}};
}

json rule_json(const audit::Rule& rule) {
    const std::string title(rule.title), detection(rule.detection), correction(rule.correction);
    std::string help = detection.empty() ? correction : "Seen as: " + detection + ". " + correction;
    if (!rule.question.empty()) {
        help += " To the laboratory: " + std::string(rule.question);
    }
    json entry = {{"id", std::string(rule.id)},
                  {"shortDescription", message(title)},
                  {"fullDescription", message(detection.empty() ? title : title + ": " + detection + ".")},
                  {"help", message(help.empty() ? title : help)},
                  {"defaultConfiguration",
                   {{"level", level_of(k_audit_severities[3 - static_cast<std::size_t>(rule.severity)])}}},
                  {"properties",
                   {{"clause", std::string(rule.clause.text)},
                    {"clauseVerified", rule.clause.verified},
                    {"severityByEffect", rule.policy == audit::SeverityPolicy::by_effect}}}};
    return entry;
}

json finite(double number) {
    return std::isfinite(number) ? json(number) : json();
}

json properties_of(const AuditFindingView& finding) {
    json all = {{"severity", finding.severity},
                {"clause", finding.clause},
                {"clauseVerified", finding.clause_verified},
                {"evidence", english_of(finding.evidence)},
                {"correction", finding.correction},
                {"question", finding.question}};
    if (finding.effect) {
        const EffectView& effect = *finding.effect;
        all["claimedU"] = finite(effect.claimed.number.U);
        all["correctedU"] = finite(effect.alone.number.U);
        all["relativeChangeOfU"] = finite(effect.change_alone.relative);
        all["share"] = finite(effect.share);
        all["direction"] = "U " + effect.change_alone.direction;
        all["decisionTurns"] = effect.change_alone.decision_turns() || effect.change_last.decision_turns();
    }
    return all;
}

std::string sentence_of(const AuditFindingView& finding) {
    std::string text = finding.title.empty() ? finding.what.english() : finding.title + ": " + finding.what.english();
    if (finding.effect) {
        const EffectView& effect = *finding.effect;
        text += ". Corrected alone, U " + effect.claimed.U + " -> " + effect.alone.U + " (" +
                effect.change_alone.percent + " %): U " + effect.change_alone.direction;
        if (effect.change_alone.verdict_turns) {
            text += ", verdict " + effect.claimed.verdict + " -> " + effect.alone.verdict;
        }
    }
    return text + ".";
}

json result_json(const AuditFindingView& finding, std::size_t file, const AuditView& view,
                 std::span<const audit::Rule> rules) {
    const auto rule =
        std::find_if(rules.begin(), rules.end(), [&finding](const audit::Rule& one) { return one.id == finding.id; });
    json logical = json::array();
    if (!finding.where.empty()) {
        logical.push_back({{"fullyQualifiedName", finding.where}, {"kind", "element"}});
    }
    for (const std::size_t result : finding.results) {
        json name = {{"fullyQualifiedName", view.files[file].results[result].name}, {"kind", "variable"}};
        // The format has each location once; points of a table may share a name.
        if (std::find(logical.begin(), logical.end(), name) == logical.end()) {
            logical.push_back(std::move(name));
        }
    }
    json location = {
        {"physicalLocation", {{"artifactLocation", {{"uri", reference_to(view.files[file].name)}, {"index", file}}}}}};
    if (!logical.empty()) {
        location["logicalLocations"] = std::move(logical);
    }
    json entry = {{"ruleId", finding.id},
                  {"level", level_of(finding.severity)},
                  {"message", message(sentence_of(finding))},
                  {"locations", json::array({std::move(location)})},
                  {"properties", properties_of(finding)}};
    if (rule != rules.end()) {
        entry["ruleIndex"] = rule - rules.begin();
    }
    if (finding.waiver) {
        const PrintedWaiver& waiver = view.waivers[*finding.waiver];
        entry["suppressions"] =
            json::array({{{"kind", "external"},
                          {"status", "accepted"},
                          {"justification", waiver.reason + " (" + waiver.by + ", " + waiver.when + ")"}}});
    }
    return entry;
}

std::string why(const UnauditedFile& file) {
    switch (file.kind) {
        case UnauditedFile::Kind::refused:
            return file.because;
        case UnauditedFile::Kind::in_record:
            return file.file + ": evaluated again for the record " + file.because + ", which was made of it";
        case UnauditedFile::Kind::other_kind:
            return file.file + ": of no kind that an audit reads";
    }
    return "";
}

}  // namespace

std::string audit_as_sarif(const AuditView& view, std::span<const audit::Rule> rules) {
    json tool_rules = json::array(), artifacts = json::array(), results = json::array(), notes = json::array();
    for (const audit::Rule& rule : rules) {
        tool_rules.push_back(rule_json(rule));
    }
    for (std::size_t i = 0; i < view.files.size(); ++i) {
        const AuditedFileView& file = view.files[i];
        json artifact = {{"location", {{"uri", reference_to(file.name)}, {"index", i}}},
                         {"roles", json::array({"analysisTarget"})}};
        if (!file.sha256.empty()) {
            artifact["hashes"] = {{"sha-256", file.sha256}};
        }
        artifacts.push_back(std::move(artifact));
        for (const AuditFindingView& finding : file.findings) {
            results.push_back(result_json(finding, i, view, rules));
        }
        for (const NotCheckedView& one : file.not_checked) {
            notes.push_back(
                {{"associatedRule", {{"id", one.id}}},
                 {"level", "note"},
                 {"message", message(file.name + ": " + one.id + " was not checked: " + one.because.english())}});
        }
        for (const audit::Sentence& sentence : file.not_read) {
            notes.push_back({{"level", "warning"}, {"message", message(file.name + ": " + sentence.english())}});
        }
        if (file.sampled_shares) {
            notes.push_back({{"level", "note"},
                             {"message", message(file.name + ": shares are means over random orders of corrections")}});
        }
    }
    for (const UnauditedFile& one : view.unaudited) {
        notes.push_back({{"level", one.kind == UnauditedFile::Kind::in_record ? "note" : "warning"},
                         {"message", message(why(one))}});
    }
    const std::size_t blank = view.program.find(' ');
    json driver = {{"name", blank == std::string::npos ? "gumcert" : view.program.substr(0, blank)},
                   {"rules", std::move(tool_rules)}};
    if (blank != std::string::npos) {
        driver["version"] = view.program.substr(blank + 1);
    }
    json run = {{"tool", {{"driver", std::move(driver)}}},
                {"artifacts", std::move(artifacts)},
                {"columnKind", "unicodeCodePoints"},
                {"invocations",
                 json::array({{{"executionSuccessful", true}, {"toolConfigurationNotifications", std::move(notes)}}})},
                {"results", std::move(results)}};
    return gumcert::json::canonical_json(
        {{"$schema", "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json"},
         {"version", "2.1.0"},
         {"runs", json::array({std::move(run)})}});
}

}  // namespace gumcert::reports
