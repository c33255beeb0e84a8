#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "reports/dcc/dcc_document.h"
#include "reports/forms/asset_files.h"
#include "reports/forms/render.h"
#include "reports/view/certificate_view.h"
#include "tests/support/filled_certificate_data.h"
#include "tests/support/sample_budget_record.h"
#include "tests/support/sample_certificate.h"
#include "tests/unit/reports/dcc/dcc_samples.h"

namespace gumcert::reports {
namespace {

using certificate::CertificateData;

const std::vector<std::string> k_languages = {"en", "de", "zh-Hant", "es"};

/// The least that certificate data can be: nothing but a status.
CertificateData empty_data() {
    CertificateData data;
    data.status = "accredited";
    return data;
}

EvaluationRecord record_with(const CertificateData& data, const std::string& verdict = "pass") {
    EvaluationRecord record = test::sample_budget_record();
    certificate::Certificate certificate;
    certificate.data = data;
    certificate.profile.id = "ilac";
    certificate.tables = certified_tables(record);
    for (const certificate::AgreedSpecification& s : data.specifications) {
        certificate::Verdict v = test::sample_verdict(s.id, verdict);
        v.rule = s.rule.id;
        certificate.tables.front().columns.front().values.front().verdict = v;
    }
    record.certificate = certificate;
    return record;
}

/// Every form of the document. What typesets the PDF takes the view and adds no words.
void expect_all_forms(const EvaluationRecord& record, const std::string& what) {
    for (const std::string& language : k_languages) {
        const RenderAssets assets = test::dcc_assets({language});
        const auto form = [&](const char* name, const auto& render) {
            try {
                EXPECT_FALSE(render().empty()) << name << ", " << language << ", " << what;
            } catch (const std::exception& error) {
                ADD_FAILURE() << name << ", " << language << ", " << what << ": " << error.what();
            }
        };
        form("HTML", [&] { return render_html(record, assets); });
        form("text", [&] { return render_text(record, assets); });
        form("data of the PDF", [&] { return certificate_view(record, read_wording(assets, record)); });
        form("DCC", [&] { return render_dcc(record, assets); });
    }
}

std::size_t number_of_keys() {
    CertificateData data = empty_data();
    test::KeyFiller filler(test::KeyFiller::k_every);
    describe(filler, data);
    return filler.count();
}

/// Law: whatever a job may state, every form in every language has words for it.
TEST(EveryCertificateKey, RendersAlone) {
    const std::size_t count = number_of_keys();
    EXPECT_GT(count, 120U);
    std::set<std::string> seen;
    for (std::size_t i = 0; i < count; ++i) {
        CertificateData data = empty_data();
        test::KeyFiller filler(i);
        describe(filler, data);
        EXPECT_FALSE(filler.stated().empty()) << i;
        seen.insert(filler.stated());
        expect_all_forms(record_with(data), filler.stated());
    }
    EXPECT_TRUE(seen.contains("/specifications/rule/prescribed_by"));
    EXPECT_TRUE(seen.contains("/accreditation/scope/capability/points/at"));
    EXPECT_EQ(seen.size(), count);
}

TEST(EveryCertificateKey, RendersWithAllOthers) {
    for (std::size_t turn = 0; turn < 8; ++turn) {  // more than any key has words
        CertificateData data = empty_data();
        test::KeyFiller filler(test::KeyFiller::k_every, turn);
        describe(filler, data);
        expect_all_forms(record_with(data), "all keys, turn " + std::to_string(turn));
    }
}

TEST(EveryCertificateKey, RendersWithEveryRuleAndVerdict) {
    for (int rule = 1; rule <= 13; ++rule) {
        const std::string id = (rule < 10 ? "DR-0" : "DR-") + std::to_string(rule);
        for (const char* verdict :
             {"pass", "fail", "conditional_pass", "conditional_fail", "undetermined", "not_applicable"}) {
            CertificateData data = empty_data();
            certificate::AgreedSpecification specification;
            specification.id = "limits";
            specification.rule.id = id;
            data.specifications = {specification};
            test::KeyFiller filler(test::KeyFiller::k_every);
            describe(filler, data.specifications.front());
            ASSERT_EQ(data.specifications.front().rule.id, id);
            expect_all_forms(record_with(data, verdict), id + " " + verdict);
        }
    }
}

// Pins: the digital certificate stated the sentences of an accreditation body where its symbol could not stand.
TEST(SentencesOfTheBody, StandInEveryFormAndOnlyWhereTheSymbolMay) {
    EvaluationRecord record = record_with(empty_data());
    certificate::LocalisedText sentence;
    sentence.plain = "The accreditation covers the marked results";
    record.certificate->profile.first_page_sentences = {sentence};
    for (const bool symbol : {false, true}) {
        record.certificate->symbol = symbol;
        for (const std::string& language : k_languages) {
            const RenderAssets assets = test::dcc_assets({language});
            for (const std::string& form :
                 {render_html(record, assets), render_text(record, assets), render_dcc(record, assets)}) {
                EXPECT_EQ(form.find(sentence.plain) != std::string::npos, symbol)
                    << language << ": " << form.substr(0, 60);
            }
        }
    }
}

}  // namespace
}  // namespace gumcert::reports
