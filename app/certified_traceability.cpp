#include "app/certified_traceability.h"

#include <algorithm>
#include <cstddef>
#include <string>

#include "certificate/finding_list.h"
#include "certificate/stated_text.h"
#include "certificate/text_words.h"

namespace gumcert::app {

namespace {

using certificate::Finding;
using certificate::FindingSeverity;
using certificate::StandardUsed;

void collect_sources(const std::vector<reports::BudgetRow>& rows, std::vector<std::u32string>& sources) {
    for (const reports::BudgetRow& row : rows) {
        sources.push_back(certificate::letters_of(row.source));
        collect_sources(row.components, sources);
    }
}

bool is_named(const std::string& text, const std::vector<std::u32string>& sources) {
    const std::u32string letters = certificate::letters_of(text);
    return certificate::is_stated(text) && letters.size() > 1 &&
           std::any_of(sources.begin(), sources.end(),
                       [&](const std::u32string& source) { return source.find(letters) != std::u32string::npos; });
}

bool is_named(const StandardUsed& s, const std::vector<std::u32string>& sources) {
    return is_named(s.identification, sources) || is_named(s.certificate, sources) ||
           is_named(s.name.in("en"), sources);
}

}  // namespace

std::vector<Finding> traceability_findings(const reports::EvaluationRecord& record) {
    if (record.kind != "budget" || !record.certificate) {
        return {};
    }
    std::vector<std::u32string> sources;
    for (const reports::Result& result : record.results) {
        collect_sources(result.budget, sources);
    }
    const std::vector<StandardUsed>& standards = record.certificate->data.standards;
    if (sources.empty() || standards.empty()) {
        return {};
    }
    const std::string clause = certificate::iso_17025("6.5");
    if (std::none_of(standards.begin(), standards.end(), [&](const StandardUsed& s) { return is_named(s, sources); })) {
        return {{.id = "T06",
                 .clause = clause,
                 .severity = FindingSeverity::major,
                 .where = "/standards",
                 .what = "no input of the budget names one of the standards as its source",
                 .action =
                     "State in \"source\" of the inputs the identification of the standard or its certificate, or "
                     "list the standards that were used."}};
    }
    std::vector<Finding> findings;
    for (std::size_t i = 0; i < standards.size(); ++i) {
        if (!is_named(standards[i], sources)) {
            findings.push_back({.id = "T06",
                                .clause = clause,
                                .severity = FindingSeverity::minor,
                                .where = certificate::place_in("/standards", i),
                                .what = "no input of the budget names the standard \"" + standards[i].name.in("en") +
                                        "\" as its source",
                                .action = "State it in \"source\" of the input that comes from it, or remove it from "
                                          "the list."});
        }
    }
    return findings;
}

}  // namespace gumcert::app
