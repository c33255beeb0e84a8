#include "audit/rules/rules_page.h"

#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "audit/checklists.h"
#include "text/lists.h"

namespace gumcert::audit {
namespace {

constexpr std::array<std::pair<char, std::string_view>, 12> k_families{{
    {'U', "Inputs: Type A and Type B"},
    {'S', "Model and sensitivity"},
    {'K', "Combination and coverage"},
    {'W', "Tables and workbooks"},
    {'B', "Completeness of contributors"},
    {'X', "Capability and scope"},
    {'T', "Traceability and equipment"},
    {'E', "Environment"},
    {'R', "Reporting"},
    {'D', "Conformity"},
    {'N', "Comparisons"},
    {'P', "Records, people, software"},
}};

constexpr std::string_view k_beginning =
    R"(# Rules of the audit

What `gumcert audit` looks for. Ids never change and are never used again. This page is written from the rules themselves
by `write_audit_rules`; a test compares the bytes.

**Severity.** *By effect*: the correction is applied, u_c, ν_eff, k, U, verdict and E_n are evaluated again, and the finding
is critical where a verdict or |E_n| > 1 turns or U was understated by 10 % or more, major where a printed digit changes,
minor below. Where nobody knows the correction, the severity behind it holds, and the finding says how large a missing
contribution would have to be. *Fixed*: documents, traceability, and what no number shows.

**Clauses.** A clause that was not held against the document itself is marked (clause to be verified). Editions of the
catalogue: JCGM 100:2008, JCGM 101:2008, ISO/IEC 17025:2017, ILAC-P14:09/2020, ISO 13528:2022.

**Gates.** Many rules take what the gates of a certificate have found already ([findings.md](findings.md)); the ids of the
gates are named where they do, and some mean something else than the same id here.
)";

/// A text in a cell of a table.
std::string cell(std::string_view text) {
    std::string escaped;
    for (const char c : text) {
        if (c == '|') {
            escaped += '\\';
        }
        escaped += c;
    }
    return escaped;
}

std::string_view severity_in_words(FindingSeverity severity) {
    switch (severity) {
        case FindingSeverity::information:
            return "information";
        case FindingSeverity::minor:
            return "minor";
        case FindingSeverity::major:
            return "major";
        case FindingSeverity::critical:
            return "critical";
    }
    return "";
}

std::string row_of(const Rule& rule) {
    std::string row = "| " + cell(rule.id) + " | " + cell(rule.title) + " | " + cell(rule.clause.text);
    row += rule.clause.text.empty() ? "–" : (rule.clause.verified ? "" : " (clause to be verified)");
    row += rule.policy == SeverityPolicy::fixed ? " | fixed: " : " | by effect; else ";
    row += severity_in_words(rule.severity);
    row += " | " + cell(rule.detection) + " | " + cell(rule.correction) + " | " + cell(rule.question) + " |\n";
    return row;
}

constexpr std::string_view k_checklists = R"(
## Contributors by method

What B01 asks of the budgets of a method, beside the minimum of every method. A row stands for a contributor by what it is
or by its words, in English or German; the method is that which the file names, or which the name of budget, certificate
or file has in its words. The lists follow the documents named; no list was held against their clauses (clauses to be
verified).

| method | id | contributors | after |
|---|---|---|---|
)";

std::string row_of(const MethodChecklist& checklist) {
    std::vector<std::string> names;
    for (const RequiredContributor& required : checklist.required) {
        names.push_back(required.name.english());
    }
    return "| " + cell(checklist.title.english()) + " | `" + std::string(checklist.method) + "` | " +
           cell(text::listed(names)) + " | " + cell(checklist.source) + " |\n";
}

}  // namespace

std::string rules_page(std::span<const Rule> rules, std::span<const RuleLeftOut> left_out) {
    std::string page(k_beginning);
    for (const auto& [letter, title] : k_families) {
        std::string rows;
        for (const Rule& rule : rules) {
            rows += rule.id.starts_with(letter) ? row_of(rule) : "";
        }
        if (!rows.empty()) {
            page += "\n## " + std::string(title) +
                    "\n\n| id | finding | clause | severity | seen by | correction | question to the "
                    "laboratory |\n|---|---|---|---|---|---|---|\n" +
                    rows;
        }
    }
    if (!left_out.empty()) {
        page +=
            "\n## Not applied\n\nRules of the catalogue whose data nobody states yet.\n\n| id | finding | why "
            "|\n|---|---|---|\n";
        for (const RuleLeftOut& rule : left_out) {
            page += "| " + cell(rule.id) + " | " + cell(rule.title) + " | " + cell(rule.because) + " |\n";
        }
    }
    page += k_checklists;
    for (const MethodChecklist& checklist : method_checklists()) {
        page += row_of(checklist);
    }
    return page;
}

}  // namespace gumcert::audit
