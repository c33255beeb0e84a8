#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "reports/record/evaluation_record.h"
#include "tests/support/json_schema.h"
#include "tests/support/sample_budget_record.h"
#include "tests/support/sample_certificate.h"

namespace gumcert::reports {
namespace {

using certificate::Certificate;
using certificate::CertificateData;
using certificate::CertifiedTable;
using certificate::CertifiedValue;
using nlohmann::json;

certificate::Verdict sample_verdict() {
    certificate::Verdict v;
    v.specification = "length";
    v.rule = "DR-03";
    v.formula = "AU = TU − U";
    v.lower = 49999000.0;
    v.upper = 50001000.0;
    v.acceptance_lower = 49999093.0;
    v.acceptance_upper = 50000907.0;
    v.guard_band = 93.0;
    v.verdict = "pass";
    v.conformance_probability = 0.9999;
    v.specific_risk = 0.0001;
    v.largest_specific_risk = 0.0228;
    v.false_accept = 0.001;
    v.false_reject = 0.002;
    v.test_uncertainty_ratio = 10.8;
    v.verdict_from_printed = "pass";
    v.note = "A sentence.";
    v.printed.lower = "49999000";
    v.printed.test_uncertainty_ratio = "11";
    return v;
}

CertifiedTable sample_table() {
    CertifiedValue first;
    first.value = 50000838.0;
    first.u = 31.7;
    first.U = 92.6;
    first.k = 2.92;
    first.nu_eff = 16.7;
    first.printed_value = "50000838";
    first.printed_U = "93";
    first.printed_k = "2.92";
    first.scope_entry = "L1";
    first.capability = 55.9;
    first.printed_capability = "56";
    first.verdict = sample_verdict();
    CertifiedValue second;
    second.value = 1.0;
    second.coverage = "monte_carlo";
    second.interval = std::pair{0.5, 1.75};
    second.printed_low = "0.50";
    second.printed_high = "1.75";
    second.outside_because = "no entry of the scope names it";
    second.raised = second.external = true;
    CertifiedTable table;
    table.id = "results";
    table.argument = CertifiedTable::Argument{
        .name = "point", .unit = "mm", .printed_unit = "mm", .values = {1.5, std::nullopt}, .printed = {"1.5", "b"}};
    table.columns = {{.result = "l",
                      .name = test::in_two_languages("length", "Länge"),
                      .unit = "nm",
                      .printed_unit = "nm",
                      .values = {first, second}}};
    return table;
}

/// Everything that a certificate may hold in a record.
EvaluationRecord sample_certificate_record() {
    EvaluationRecord r = test::sample_budget_record();
    Certificate& c = r.certificate.emplace();
    c.data = test::sample_certificate_data();
    c.data.opinions = {test::sample_opinion()};
    c.data.amendment = certificate::Amendment{
        .kind = "amended", .number = "EX-1", .sha256 = "", .reason = "Typing error", .changes = {"Serial number"}};
    c.data.external_results = {{.results = {"x"}, .provider = "Other"}};
    c.data.parameters = {{.name = "T", .unit = "degC", .value = 20.1}};
    c.data.omissions = {{.clause = "7.8.2.1 k", .reason = "No sampling"}};
    c.data.own_profile.emplace().id = "own";
    certificate::Capability& matrix = c.data.accreditation->scope[2].capability;
    matrix.form = "matrix";
    matrix.rows = {1.0, 2.0};
    matrix.columns = {18.0, 22.0};
    matrix.matrix = {{0.1, 0.2}, {0.3, 0.4}};
    matrix.lookup = "linear";
    matrix.points = {{.at = 0.1, .U = 0.8}};
    c.profile.id = "ilac";
    c.profile.name = "ILAC";
    c.profile.sources = {"ILAC-P14:09/2020"};
    c.profile.required_languages = {"en"};
    c.profile.first_page_sentences = {"A sentence.", test::in_two_languages("B", "C")};
    c.tables = {sample_table()};
    c.findings = {{.id = "X06",
                   .clause = "ILAC-P8",
                   .severity = certificate::FindingSeverity::information,
                   .where = "l",
                   .what = "w",
                   .action = "a"},
                  {.id = "R07-e",
                   .clause = "ISO/IEC 17025:2017, 7.8.2.1 e",
                   .severity = certificate::FindingSeverity::critical,
                   .where = "/customer/name",
                   .what = "w",
                   .action = "a"}};
    c.blocked = true;
    return r;
}

json parsed(const EvaluationRecord& record) {
    return json::parse(to_canonical_json(record));
}

/// What later releases added to the laboratory is in records that state it, and nothing of it in others.
TEST(CertificateInRecord, HasLogoAndPartsOfAnAddressOnlyWhereTheyAreStated) {
    EvaluationRecord record = sample_certificate_record();
    certificate::Laboratory& laboratory = record.certificate->data.laboratory;
    const json without = parsed(record)["certificate"]["data"]["laboratory"];
    for (const char* key : {"logo", "logo_sha256", "logo_media_type", "logo_base64"}) {
        EXPECT_FALSE(without.contains(key)) << key;
    }
    for (const char* key : {"street", "street_no", "post_office_box", "postcode", "city", "state"}) {
        EXPECT_FALSE(without["address"].contains(key)) << key;
    }
    laboratory.logo = "logo.svg";
    laboratory.logo_sha256 = std::string(64, 'a');
    laboratory.logo_media_type = "image/svg+xml";
    laboratory.logo_base64 = "PHN2Zy8+";
    laboratory.address.street = "Example Street";
    laboratory.address.postcode = "12345";
    const std::string text = to_canonical_json(record);
    const EvaluationRecord back = record_from_json(text, "r.json");
    EXPECT_EQ(to_canonical_json(back), text);
    EXPECT_EQ(back.certificate->data.laboratory.logo_base64, "PHN2Zy8+");
    EXPECT_EQ(back.certificate->data.laboratory.address, laboratory.address);
}

TEST(CertificateInRecord, MakesTheRoundTrip) {
    const EvaluationRecord record = sample_certificate_record();
    const std::string text = to_canonical_json(record);
    const EvaluationRecord back = record_from_json(text, "r.json");
    EXPECT_EQ(to_canonical_json(back), text);
    ASSERT_TRUE(back.certificate);
    const CertificateData& data = back.certificate->data;
    EXPECT_EQ(data.accreditation->symbol_base64, record.certificate->data.accreditation->symbol_base64);
    EXPECT_EQ(data.laboratory.name, record.certificate->data.laboratory.name);
    EXPECT_EQ(data.laboratory.address, record.certificate->data.laboratory.address);
    EXPECT_EQ(data.specifications[0].upper, 50001000.0);
    EXPECT_FALSE(data.specifications[0].rule.guard_factor);
    EXPECT_EQ(data.own_profile->id, "own");
    EXPECT_EQ(data.accreditation->scope[2].capability.matrix[1][0], 0.3);
    const CertifiedTable& table = back.certificate->tables.at(0);
    EXPECT_EQ(table.argument->values, (std::vector<std::optional<double>>{1.5, std::nullopt}));
    EXPECT_EQ(table.columns[0].values[1].interval, (std::pair{0.5, 1.75}));
    EXPECT_EQ(table.columns[0].values[0].verdict->printed.test_uncertainty_ratio, "11");
    EXPECT_EQ(back.certificate->findings[1].severity, certificate::FindingSeverity::critical);
    EXPECT_TRUE(back.certificate->blocked);
    EXPECT_EQ(back.certificate->profile.digits, 2);
    EXPECT_EQ(back.certificate->profile.first_page_sentences[1].in("de"), "C");
}

TEST(CertificateInRecord, MayBeMissing) {
    json record = parsed(test::sample_budget_record());
    EXPECT_TRUE(record.at("certificate").is_null());
    record.erase("digest");
    EXPECT_FALSE(record_from_json(record.dump(), "r.json").certificate);
    record.erase("certificate");  // as earlier releases wrote it
    EXPECT_FALSE(record_from_json(record.dump(), "r.json").certificate);
}

// A text in some languages comes back in the order of the program, whatever the order of the letters in JSON.
TEST(CertificateInRecord, KeepsTheOrderOfLanguages) {
    EvaluationRecord record = sample_certificate_record();
    record.certificate->data.sampling.by_language = {{"en", "a"}, {"de", "b"}, {"zh-Hant", "c"}, {"es", "d"}};
    EXPECT_EQ(record_from_json(to_canonical_json(record), "r.json").certificate->data.sampling,
              record.certificate->data.sampling);
}

TEST(CertificateInRecord, WriterRefusesWhatWouldBeLost) {
    const std::vector<std::pair<std::string, std::function<void(Certificate&)>>> breaks = {
        {"/certificate/data/sampling",
         [](Certificate& c) {
             c.data.sampling = {"plain"}, c.data.sampling.by_language = {{"en", "a"}};
         }},
        {"/certificate/data/sampling",
         [](Certificate& c) {
             c.data.sampling.by_language = {{"fr", "a"}};
         }},
        {"/certificate/data/status", [](Certificate& c) { c.data.status = "good"; }},
        {"/certificate/data/languages", [](Certificate& c) { c.data.languages.clear(); }},
        {"/certificate/data/languages/0", [](Certificate& c) { c.data.languages = {"fr"}; }},
        {"/certificate/profile/digits", [](Certificate& c) { c.profile.digits = 3; }},
        {"/certificate/tables/0/columns/0/values/0/U",
         [](Certificate& c) { c.tables[0].columns[0].values[0].U = -1.0; }},
        {"/certificate/tables/0/columns/0/values/0/verdict/verdict",
         [](Certificate& c) { c.tables[0].columns[0].values[0].verdict->verdict = "maybe"; }},
        {"/certificate/tables/0/columns/0/values", [](Certificate& c) { c.tables[0].columns[0].values.pop_back(); }},
        {"/certificate/tables/0/columns/0/values", [](Certificate& c) { c.tables[0].argument.reset(); }},
        {"/certificate/tables/0/argument/values", [](Certificate& c) { c.tables[0].argument->values.pop_back(); }},
        {"/certificate/tables/0/columns/0/values/1/interval",
         [](Certificate& c) {
             c.tables[0].columns[0].values[1].interval = {2.0, 1.0};
         }},
    };
    for (const auto& [place, spoil] : breaks) {
        EvaluationRecord record = sample_certificate_record();
        spoil(*record.certificate);
        try {
            (void)to_canonical_json(record);
            ADD_FAILURE() << place;
        } catch (const gum::NoResultError& error) {
            EXPECT_EQ(error.diagnostics().front().where, "record#" + place);
        }
    }
}

class CertificateRecordSchema : public testing::Test {
protected:
    [[nodiscard]] bool accepts(const json& record) const { return schema_.accepts(record); }
    const test::JsonSchema schema_{"record-1.schema.json"};
};

TEST_F(CertificateRecordSchema, AcceptsCertificates) {
    EXPECT_TRUE(accepts(parsed(sample_certificate_record())));
    EvaluationRecord small = test::sample_budget_record();
    small.certificate.emplace();
    EXPECT_TRUE(accepts(parsed(small)));
}

TEST_F(CertificateRecordSchema, RefusesWhatTheReaderRefuses) {
    const json whole = parsed(sample_certificate_record());
    const std::vector<std::function<void(json&)>> breaks = {
        [](json& c) { c = 1; },
        [](json& c) { c.erase("data"); },
        [](json& c) { c["extra"] = 1; },
        [](json& c) { c["blocked"] = "yes"; },
        [](json& c) { c["data"]["status"] = "good"; },
        [](json& c) { c["data"]["number"] = 3; },
        [](json& c) { c["data"]["languages"] = "en"; },
        [](json& c) { c["data"]["customer"]["name"] = nullptr; },
        [](json& c) { c["data"]["customer"]["name"] = json::object(); },
        [](json& c) {
            c["data"]["customer"]["name"] = {{"fr", "x"}};
        },
        [](json& c) { c["data"]["item"]["stated_by_customer"] = {"colour"}; },
        [](json& c) { c["data"]["accreditation"]["scope"][0].erase("capability"); },
        [](json& c) { c["data"]["accreditation"]["scope"][0]["places"] = {"moon"}; },
        [](json& c) { c["data"]["standards"][0]["U"] = 0; },
        [](json& c) { c["data"]["standards"][0]["k"] = 0.5; },
        [](json& c) { c["data"]["persons"]["authorised_by"]["name"] = 1; },
        [](json& c) { c["data"]["specifications"][0]["rule"].erase("id"); },
        [](json& c) { c["data"]["adjustment"]["adjusted"] = 0; },
        [](json& c) { c["data"]["amendment"]["kind"] = ""; },
        [](json& c) { c["profile"]["digits"] = 1.5; },
        [](json& c) { c["profile"]["digits"] = 3; },
        [](json& c) { c["profile"]["rounding"] = "down"; },
        [](json& c) { c["tables"][0]["columns"][0]["values"][0]["value"] = "1"; },
        [](json& c) { c["tables"][0]["columns"][0]["values"][0]["coverage"] = "k = 2"; },
        [](json& c) { c["tables"][0]["columns"][0]["values"][1]["interval"] = {1}; },
        [](json& c) { c["tables"][0]["columns"][0]["values"][0]["verdict"]["printed"].erase("lower"); },
        [](json& c) { c["tables"][0]["columns"][0]["values"][0]["verdict"]["specific_risk"] = 1.5; },
        [](json& c) { c["tables"][0]["argument"]["values"][0] = "1"; },
        [](json& c) { c["findings"][0]["severity"] = "fatal"; },
    };
    for (std::size_t i = 0; i < breaks.size(); ++i) {
        json broken = whole;
        breaks[i](broken["certificate"]);
        EXPECT_FALSE(accepts(broken)) << "break " << i;
        EXPECT_THROW(static_cast<void>(record_from_json(broken.dump(), "x")), gum::InputError) << "break " << i;
    }
}

}  // namespace
}  // namespace gumcert::reports
