#include "issuing/issue_documents.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "reports/forms/pdf_conformity.h"
#include "signing/qpdf_objects.h"
#include "signing/verify.h"
#include "tests/unit/reports/certified_sample.h"
#include "tests/unit/reports/document_text.h"
#include "tests/unit/signing/test_keys.h"

// One record, one key: HTML, digital certificate and PDF as a laboratory hands them out.

namespace gumcert::issuing {
namespace {

using reports::EvaluationRecord;
using reports::pdf_is_possible;
using signing::test::Key;
using signing::test::Laboratory;
using testing::HasSubstr;
using testing::IsEmpty;

/// The file that is attached to a PDF; there must be one.
std::string attachment_of(const std::string& pdf) {
    QPDF document;
    document.processMemoryFile("certificate.pdf", pdf.data(), pdf.size());
    const auto files = QPDFEmbeddedFileDocumentHelper(document).getEmbeddedFiles();
    EXPECT_EQ(files.size(), 1U);
    if (files.empty()) {
        return {};
    }
    const auto data = files.begin()->second->getEmbeddedFileStream().getStreamData();
    return {reinterpret_cast<const char*>(data->getBuffer()), data->getSize()};
}

std::string findings_text(const std::vector<gum::Diagnostic>& findings) {
    std::string text;
    for (const gum::Diagnostic& finding : findings) {
        text += gum::message(finding) + '\n';
    }
    return text;
}

void expect_valid(const std::string& document, const Laboratory& laboratory) {
    const signing::Verification verification =
        signing::verify_signatures(document, "certificate", laboratory.trusted(), signing::test::k_now);
    EXPECT_TRUE(verification.valid);
    ASSERT_EQ(verification.signatures.size(), 1U);
    EXPECT_EQ(verification.signatures[0].signing_time, "2026-03-31T12:00:00Z");
    EXPECT_EQ(verification.signatures[0].signer, "CN=Example Calibration Laboratory");
}

/// What a run writes of a certificate.
struct Bytes {
    std::string html, pdf, dcc;
};

Bytes bytes_of(const std::vector<IssuedDocument>& documents) {
    EXPECT_EQ(documents.size(), 3U);
    const auto of = [&](std::string_view form) {
        const auto found =
            std::ranges::find_if(documents, [&](const IssuedDocument& d) { return d.form->name == form; });
        return found == documents.end() ? std::string() : found->bytes;
    };
    return {.html = of("html"), .pdf = of("pdf"), .dcc = of("dcc")};
}

class IssuedDocuments : public testing::Test {
protected:
    [[nodiscard]] IssueOptions options(const signing::Signer* signer) {
        return {.assets = reports::assets(),
                .signer = signer,
                .signing_time = signing::test::k_signing_time,
                .worker = &worker_};
    }
    reports::PdfWorker worker_{reports::assets()};
};

/// What was issued holds until the one that takes its place is issued: a draft, a specimen and one of tomorrow supersede nothing.
TEST(Supersede, AsksWhetherTheLaterOneMayBeIssued) {
    const auto refusal = [](EvaluationRecord record, const EvaluationRecord& later) -> std::string {
        try {
            supersede(record, later, "old.json", "new.json", "2026-11-22");
        } catch (const gum::InputError& error) {
            EXPECT_EQ(error.diagnostics().front().code, "GC-CERT-0309");
            return error.diagnostics().front().what;
        }
        EXPECT_EQ(record.certificate ? record.certificate->superseded_by : record.comparison->issuer->superseded_by,
                  "EX-1/A1");
        return "";
    };
    EvaluationRecord record = test::certified_budget_record();
    record.certificate->data.number = "EX-1";
    EvaluationRecord later = record;
    later.certificate->data.number = "EX-1/A1";
    EXPECT_THAT(refusal(record, later), HasSubstr("not the record of an amendment"));
    certificate::Amendment amendment;
    amendment.kind = "amended";
    amendment.number = "EX-1";
    later.certificate->data.amendment = amendment;
    later.certificate->data.dates.issued = "2026-11-23";  // today elsewhere
    EXPECT_EQ(refusal(record, later), "");
    later.certificate->data.dates.issued = "2026-11-24";
    EXPECT_EQ(refusal(record, later), "dated 2026-11-24, later than today, 2026-11-22");
    later.certificate->data.dates.issued = "2026-11-21";
    EXPECT_EQ(refusal(record, test::drafted(later)), "a draft: critical findings block its issue");
    later.certificate->data.status = "specimen";
    EXPECT_EQ(refusal(record, later), "a specimen");
    EvaluationRecord specimen = record;
    specimen.certificate->data.status = "specimen";
    EXPECT_EQ(refusal(specimen, later), "");
    later.certificate->data.status = record.certificate->data.status;
    EXPECT_EQ(refusal(specimen, later), "");
    later.certificate->data.dates.issued = "";
    EXPECT_EQ(refusal(record, later), "without a date of issue");

    EvaluationRecord report;
    report.comparison.emplace().issuer.emplace().number = "EX-1";
    EvaluationRecord later_report = report;
    later_report.comparison->issuer->number = "EX-1/A1";
    later_report.comparison->issuer->amendment = amendment;
    EXPECT_EQ(refusal(report, later_report), "without a date of issue");
    later_report.comparison->issuer->issued = "2026-11-22";
    EXPECT_EQ(refusal(report, later_report), "");
    later_report.comparison->issuer->issued = "2027-01-01";
    EXPECT_THAT(refusal(report, later_report), HasSubstr("later than today"));
    EXPECT_THAT(refusal(report, later), HasSubstr("a certificate, and what is printed is"));
}

TEST_F(IssuedDocuments, AreSignedOneInsideOfTheOther) {
    SKIP_WITHOUT_PDF();
    const Key keys[] = {signing::test::rsa_key(3072), signing::test::ec_key()};
    const EvaluationRecord records[] = {test::certified_budget_record(), test::certified_rotary_record()};
    for (const Key& key : keys) {
        const Laboratory laboratory(key);
        for (const EvaluationRecord& record : records) {
            const Bytes documents = bytes_of(issue_documents(record, options(laboratory.signer.get())));
            expect_valid(documents.dcc, laboratory);
            expect_valid(documents.pdf, laboratory);
            // The PDF carries the digital certificate as it was signed, and signing has not spoilt the PDF/A.
            EXPECT_EQ(attachment_of(documents.pdf), documents.dcc);
            const auto findings = reports::check_pdf(documents.pdf, documents.dcc);
            EXPECT_THAT(findings, IsEmpty()) << findings_text(findings);
            const signing::Verification of_pdf = signing::verify_signatures(documents.pdf, "certificate.pdf",
                                                                            laboratory.trusted(), signing::test::k_now);
            ASSERT_EQ(of_pdf.attachment_signatures.size(), 1U);
            EXPECT_TRUE(of_pdf.attachment_signatures[0].valid);
            EXPECT_EQ(of_pdf.signatures[0].format, "PAdES-BASELINE-B");
            EXPECT_EQ(of_pdf.attachment_signatures[0].format, "XAdES-BASELINE-B");
            EXPECT_THAT(documents.html, HasSubstr("<html"));

            const Laboratory stranger(signing::test::ec_key());
            EXPECT_FALSE(
                signing::verify_signatures(documents.pdf, "c.pdf", stranger.trusted(), signing::test::k_now).valid);
        }
    }
}

TEST_F(IssuedDocuments, AreTheSameBytesEachTimeWithRsa) {
    SKIP_WITHOUT_PDF();
    const Laboratory laboratory(signing::test::rsa_key());
    const EvaluationRecord record = test::certified_budget_record();
    const Bytes first = bytes_of(issue_documents(record, options(laboratory.signer.get())));
    IssueOptions without_worker = options(laboratory.signer.get());
    without_worker.worker = nullptr;
    const Bytes second = bytes_of(issue_documents(record, without_worker));
    EXPECT_EQ(first.html, second.html);
    EXPECT_EQ(first.dcc, second.dcc);
    EXPECT_EQ(first.pdf, second.pdf);
    // One form at a time gives the same document.
    EXPECT_EQ(issue_document(record, "pdf", options(laboratory.signer.get())), first.pdf);
    EXPECT_EQ(issue_document(record, "dcc", options(laboratory.signer.get())), first.dcc);
    // The time of signing is all that differs a second later.
    IssueOptions later = options(laboratory.signer.get());
    later.signing_time += 1;
    EXPECT_EQ(issue_document(record, "html", later), first.html);
    EXPECT_NE(issue_document(record, "dcc", later), first.dcc);
}

TEST_F(IssuedDocuments, WithEcdsaDifferInTheValueOfTheSignatureAlone) {
    const Laboratory laboratory(signing::test::ec_key());
    const EvaluationRecord record = test::certified_budget_record();
    const auto dcc = [&] { return issue_document(record, "dcc", options(laboratory.signer.get())); };
    const auto without_value = [](std::string text) {
        const std::size_t from = text.find("<ds:SignatureValue>");
        return text.erase(from, text.find("</ds:SignatureValue>") - from);
    };
    const std::string first = dcc();
    const std::string second = dcc();
    EXPECT_NE(first, second);  // each ECDSA signature has a random number in it
    EXPECT_EQ(without_value(first), without_value(second));
}

TEST_F(IssuedDocuments, OfADraftOrASpecimenAreNotSigned) {
    const Laboratory laboratory(signing::test::ec_key());
    EvaluationRecord specimen = test::certified_budget_record();
    specimen.certificate->data.status = "specimen";
    for (const EvaluationRecord& record :
         {test::drafted(test::certified_budget_record()), specimen, test::sample_budget_record()}) {
        EXPECT_THROW(static_cast<void>(issue_documents(record, options(laboratory.signer.get()))), gum::InputError);
        EXPECT_THROW(static_cast<void>(issue_document(record, "dcc", options(laboratory.signer.get()))),
                     gum::InputError);
    }
}

}  // namespace
}  // namespace gumcert::issuing
