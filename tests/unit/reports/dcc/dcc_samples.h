#pragma once

#include <libxml/catalog.h>
#include <libxml/parser.h>
#include <libxml/xmlschemas.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "reports/dcc/dcc_document.h"
#include "reports/record/certified_tables.h"
#include "tests/support/sample_budget_record.h"
#include "tests/support/sample_certificate.h"

namespace gumcert::test {

/// Those of the tree; one program of tests reads each wording once.
inline reports::RenderAssets dcc_assets(const std::vector<std::string>& languages = {}) {
    static const reports::RenderAssets of_the_tree = [] {
        reports::RenderAssets assets;
        assets.templates = std::filesystem::path(GUMCERT_SOURCE_DIR) / "templates";
        return assets;
    }();
    reports::RenderAssets assets = of_the_tree;
    assets.languages = languages;
    return assets;
}

inline std::filesystem::path shared_dcc() {
    return std::filesystem::path(GUMCERT_SHARED_DIR) / "dcc";
}

inline std::string content_of(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream whole;
    whole << stream.rdbuf();
    return whole.str();
}

/// A verdict with everything printed, in the unit of the column.
inline certificate::Verdict sample_verdict(const std::string& specification, const std::string& verdict) {
    certificate::Verdict v;
    v.specification = specification;
    v.rule = "DR-03";
    v.formula = "AL = TL + U; AU = TU − U";
    v.lower = -10.0;
    v.upper = 10.0;
    v.acceptance_lower = -9.5;
    v.acceptance_upper = 9.5;
    v.guard_band = 0.5;
    v.verdict = verdict;
    v.conformance_probability = 0.9999;
    v.specific_risk = 0.0001;
    v.verdict_from_printed = verdict;
    v.printed = {.lower = "-10.0",
                 .upper = "10.0",
                 .acceptance_lower = "-9.50",
                 .acceptance_upper = "9.50",
                 .guard_band = "0.50",
                 .conformance_probability = ">99.99",
                 .specific_risk = "<0.01",
                 .largest_specific_risk = "2.3",
                 .false_accept = "",
                 .false_reject = "",
                 .test_uncertainty_ratio = "20"};
    return v;
}

/// A record with the data of an accredited certificate: every value in scope, the first column decided.
inline reports::EvaluationRecord certified(reports::EvaluationRecord record, const std::string& specification) {
    certificate::Certificate c;
    c.data = sample_certificate_data();
    c.tables = reports::certified_tables(record);
    for (certificate::CertifiedTable& table : c.tables) {
        for (certificate::CertifiedColumn& column : table.columns) {
            for (certificate::CertifiedValue& value : column.values) {
                value.scope_entry = "S1";
            }
        }
    }
    for (certificate::CertifiedValue& value : c.tables.front().columns.front().values) {
        value.verdict = sample_verdict(specification, "pass");
    }
    c.symbol = true;
    record.certificate = std::move(c);
    return record;
}

inline reports::EvaluationRecord certified_budget() {
    return certified(sample_budget_record(), "length");
}

inline reports::EvaluationRecord certified_rotary_table() {
    return certified(sample_record(), "axial");
}

inline void keep_message(void* messages, xmlErrorPtr error) {
    static_cast<std::string*>(messages)->append("line " + std::to_string(error->line) + ": " + error->message);
}

/// What the schema of a version of the DCC says against a document; "" where it is valid. Offline, by the catalogue of
/// the folder.
inline std::string schema_errors(const std::string& document, const std::string& version = "3.3.0") {
    using Schema = std::unique_ptr<xmlSchema, decltype(&xmlSchemaFree)>;
    static std::map<std::string, Schema> schemas;
    auto found = schemas.find(version);
    if (found == schemas.end()) {
        xmlLoadCatalog((shared_dcc() / "xsd" / "catalog.xml").c_str());
        const std::unique_ptr<xmlSchemaParserCtxt, decltype(&xmlSchemaFreeParserCtxt)> parser(
            xmlSchemaNewParserCtxt((shared_dcc() / "xsd" / "dcc" / ("v" + version) / "dcc.xsd").c_str()),
            &xmlSchemaFreeParserCtxt);
        found = schemas.emplace(version, Schema(xmlSchemaParse(parser.get()), &xmlSchemaFree)).first;
    }
    if (!found->second) {
        return "the schema cannot be read";
    }
    std::string messages;
    const std::unique_ptr<xmlDoc, decltype(&xmlFreeDoc)> xml(
        xmlReadMemory(document.data(), static_cast<int>(document.size()), "document", nullptr, XML_PARSE_NONET),
        &xmlFreeDoc);
    if (!xml) {
        return "not well-formed";
    }
    const std::unique_ptr<xmlSchemaValidCtxt, decltype(&xmlSchemaFreeValidCtxt)> validator(
        xmlSchemaNewValidCtxt(found->second.get()), &xmlSchemaFreeValidCtxt);
    xmlSchemaSetValidStructuredErrors(validator.get(), keep_message, &messages);
    const int result = xmlSchemaValidateDoc(validator.get(), xml.get());
    return result == 0 ? messages : "invalid: " + messages;
}

}  // namespace gumcert::test
