#include "reports/dcc/dcc_document.h"

#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "reports/dcc/dcc_element.h"
#include "reports/dcc/dcc_rules.h"
#include "reports/dcc/dcc_writer.h"
#include "reports/forms/asset_files.h"
#include "reports/record/record_sections.h"
#include "reports/result_names.h"

namespace gumcert::reports {

namespace {

using InputSource = std::pair<std::string, std::string>;  // input quantity, standard or certificate it comes from

/// Where the inputs of the budgets come from, each once, in the order of the budgets: among them the number and the
/// digest of an imported certificate.
std::vector<InputSource> sources_of(const EvaluationRecord& record) {
    std::vector<InputSource> sources;
    std::set<InputSource> seen;
    const auto add = [&](const auto& self, const std::vector<BudgetRow>& rows) -> void {
        for (const BudgetRow& row : rows) {
            const InputSource source(without_outer_blanks(row.input), without_outer_blanks(row.source));
            if (!source.second.empty() && seen.insert(source).second) {
                sources.push_back(source);
            }
            self(self, row.components);
        }
    };
    for (const Result& result : record.results) {
        add(add, result.budget);
    }
    return sources;
}

/// What the evaluation rests on, so that it can be repeated: files by their digest, inputs by their source.
void write_comment(DccWriter& w) {
    const std::vector<InputSource> sources = sources_of(w.record());
    if (w.record().job_files.empty() && sources.empty() && w.record().inputs.empty()) {
        return;
    }
    w.xml.open("dcc:comment");
    w.xml.open("evaluation", {{"xmlns", "urn:gumcert:evaluation"}});
    for (const InputFile& file : w.record().job_files) {
        w.xml.element("inputFile", file.sha256.empty() ? "-" : file.sha256, {{"name", file.name}});
    }
    for (const InputQuantity& input : w.record().inputs) {
        const Text description = w.words().localised(input.description);
        for (std::size_t i = 0; i < w.words().languages().size() && !without_outer_blanks(description.in(i)).empty();
             ++i) {
            w.xml.element("inputQuantity", description.in(i),
                          {{"name", input.name}, {"unit", input.unit}, {"lang", iso_639_1(w.words().languages()[i])}});
        }
    }
    for (const auto& [input, source] : sources) {
        w.xml.element("inputSource", source_name(source, w.words()).first(),
                      {{"input", source_name(input, w.words()).first()}});
    }
    w.xml.close();
    w.xml.close();
}

std::string written(const EvaluationRecord& record, const Wording& words, const RefTypes& ref_types,
                    const std::string& changed_templates) {
    DccWriter w(record, words, ref_types);
    w.changed_templates = changed_templates;
    w.xml.open("dcc:digitalCalibrationCertificate",
               {{"xmlns:dcc", "https://ptb.de/dcc"},
                {"xmlns:si", "https://ptb.de/si"},
                {"xmlns:xsi", "http://www.w3.org/2001/XMLSchema-instance"},
                {"xsi:schemaLocation", "https://ptb.de/dcc https://ptb.de/dcc/v3.3.0/dcc.xsd"},
                {"schemaVersion", "3.3.0"}});
    write_administrative_data(w);
    w.xml.open("dcc:measurementResults");
    // The joint results are of all sections together, so they are written once, with the last one.
    const auto measurement_result = [&](const std::string& item, const Text& name, bool is_last) {
        w.xml.open("dcc:measurementResult", {{"refId", item}});
        w.text("dcc:name", name);
        write_circumstances(w);
        write_results(w, is_last);
        w.xml.close();
    };
    if (record.sections.empty()) {
        measurement_result("item_1", record.title.empty() ? words("dcc", "results") : words.localised(title_of(record)),
                           true);
    }
    for (const SectionSummary& section : record.sections) {
        w.enter_section(section.name);
        measurement_result(w.item_id(section.name), words.localised(title_of(section)),
                           &section == &record.sections.back());
    }
    w.xml.close();
    write_comment(w);
    w.xml.close();
    return w.xml.take();
}

}  // namespace

std::string render_dcc(const EvaluationRecord& record, const RenderAssets& assets) {
    const Wording words = read_wording(assets, record);
    const RefTypes ref_types = RefTypes::read(assets);
    std::string document = written(record, words, ref_types, assets.changed_templates);
    std::vector<gum::Diagnostic> breaches =
        business_rule_breaches(read_dcc_root(document, "digital certificate"), "digital certificate");
    // A document that its own check refuses is not handed out: the mistake is then in the program or in what the job
    // stated, and it would otherwise be the customer who finds it.
    std::erase_if(breaches, [](const gum::Diagnostic& d) { return d.severity != gum::Severity::error; });
    if (!breaches.empty()) {
        throw gum::NoResultError(std::move(breaches));
    }
    return document;
}

}  // namespace gumcert::reports
