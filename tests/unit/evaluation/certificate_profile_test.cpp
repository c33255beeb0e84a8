#include "evaluation/certificate_profile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "evaluation/evaluate_job.h"
#include "gum/quantity/diagnostic.h"
#include "tests/support/sample_certificate.h"

namespace gumcert::evaluation {
namespace {

const std::filesystem::path k_sources = GUMCERT_SOURCE_DIR;

TEST(CertificateProfile, ComesFromTheTemplates) {
    certificate::CertificateData data = test::sample_certificate_data();
    data.profile = "cgcre";
    const certificate::Profile profile = certificate_profile(data, k_sources / "templates");
    EXPECT_EQ(profile.id, "cgcre");
    EXPECT_EQ(profile.below_capability, "outside");
}

TEST(CertificateProfile, IsTheOneBesideTheJobWhereThereIsOne) {
    certificate::CertificateData data = test::sample_certificate_data();
    data.own_profile.emplace();
    data.own_profile->id = "own";
    EXPECT_EQ(certificate_profile(data, k_sources / "no templates").id, "own");
}

/// Words in place of others could turn a sentence of the program round.
TEST(CertificateProfile, OfALaboratoryHasNoTerms) {
    certificate::CertificateData data = test::sample_certificate_data();
    data.own_profile.emplace();
    data.own_profile->id = "own";
    data.own_profile->terms = {{.language = "en", .word = "outside of", .term = "within"}};
    try {
        (void)certificate_profile(data, k_sources / "templates");
        ADD_FAILURE();
    } catch (const gum::InputError& error) {
        EXPECT_EQ(error.diagnostics().front().code, "GC-CERT-0302");
        EXPECT_THAT(error.diagnostics().front().what, testing::HasSubstr("1 term in place of"));
    }
}

/// Terms replace words that are there, and a profile has the name of its file.
TEST(CertificateProfile, OfTheProgramHasTermsForItsWording) {
    std::size_t profiles = 0;
    for (const auto& entry : std::filesystem::directory_iterator(k_sources / "templates/profiles")) {
        certificate::CertificateData data = test::sample_certificate_data();
        data.profile = entry.path().stem().string();
        const certificate::Profile profile = certificate_profile(data, k_sources / "templates");
        ++profiles;
        EXPECT_EQ(profile.id, data.profile);
        for (const certificate::Profile::Term& term : profile.terms) {
            const std::string file = "templates/wording/" + term.language + ".json";
            std::ifstream stream(k_sources / file);
            const std::string wording{std::istreambuf_iterator<char>(stream), {}};
            EXPECT_NE(wording.find(term.word), std::string::npos) << file << ": " << term.word;
        }
    }
    EXPECT_GE(profiles, 8U);
}

/// The permanent sentences speak of the item, or of the items where sections have items of their own.
TEST(CertificateProfile, SpeaksOfOneItemOrOfSeveral) {
    for (const auto& entry : std::filesystem::directory_iterator(k_sources / "templates/profiles")) {
        certificate::CertificateData data = test::sample_certificate_data();
        data.profile = entry.path().stem().string();
        const auto sentences = [&](const char* language) {
            std::string all;
            for (const auto& sentence : certificate_profile(data, k_sources / "templates").first_page_sentences) {
                all += sentence.in(language);
            }
            return all;
        };
        using testing::HasSubstr;
        EXPECT_THAT(sentences("en"), HasSubstr("endorsement of the item by")) << data.profile;
        EXPECT_THAT(sentences("de"), HasSubstr("keine Empfehlung des Gegenstands durch"));
        EXPECT_THAT(sentences("es"), HasSubstr("avale el objeto calibrado."));
        certificate::SectionData& section = data.sections.emplace_back();
        section.item = data.item;
        EXPECT_THAT(sentences("en"), HasSubstr("of the item by")) << "a section of the same item";
        section.item->serial_number = "another one";
        EXPECT_THAT(sentences("en"), HasSubstr("endorsement of the items by"));
        EXPECT_THAT(sentences("de"), HasSubstr("keine Empfehlung der Gegenstände durch"));
        EXPECT_THAT(sentences("es"), HasSubstr("avale los objetos calibrados."));
        EXPECT_THAT(sentences("zh-Hant"), testing::Not(HasSubstr("{")));
    }
}

/// A copy of a profile of the program, from its file or from a record, is no other profile.
TEST(CertificateProfile, IsTheSameWhateverFormItsSentencesHave) {
    certificate::CertificateData data = test::sample_certificate_data();
    data.profile = "ilac";
    const certificate::Profile of_program = certificate_profile(data, k_sources / "templates");
    data.own_profile = of_program;
    EXPECT_EQ(certificate_profile(data, k_sources / "templates"), of_program);
    data.own_profile->id = "own";
    data.own_profile->first_page_sentences[0].by_language = {{"en", "As {agreed?by us|by all}, {x?}."}};
    EXPECT_EQ(certificate_profile(data, k_sources / "templates").first_page_sentences[0].in("en"),
              "As {agreed?by us|by all}, {x?}.")
        << "what a person writes in braces";
}

TEST(CertificateProfile, IsRefusedWhereThereIsNoneOfThatName) {
    certificate::CertificateData data = test::sample_certificate_data();
    for (const char* name : {"nowhere", "", "../profiles/ilac", "/etc/passwd", "ilac.json"}) {
        data.profile = name;
        try {
            (void)certificate_profile(data, k_sources / "templates");
            ADD_FAILURE() << name;
        } catch (const gum::InputError& error) {
            EXPECT_EQ(error.diagnostics().front().code, "GC-CERT-0300");
            EXPECT_THAT(error.diagnostics().front().rule, testing::HasSubstr("a2la, cgcre, dakks, enac, ilac"));
        }
    }
}

TEST(EvaluateJob, MakesACertificateOfAJobWithCertificateData) {
    const Evaluation evaluation = evaluate_job(k_sources / "examples/certificate/end_gauge.json", CovarianceFile::none,
                                               1, k_sources / "templates");
    ASSERT_TRUE(evaluation.record.certificate);
    const certificate::Certificate& c = *evaluation.record.certificate;
    EXPECT_FALSE(evaluation.blocked);
    for (const certificate::Finding& f : c.findings) {
        EXPECT_NE(f.severity, certificate::FindingSeverity::critical) << f.id << " " << f.where << ": " << f.what;
    }
    EXPECT_TRUE(c.symbol);
    EXPECT_EQ(c.profile.id, "ilac");
    const certificate::CertifiedValue& l = c.tables.at(0).columns.at(0).values.at(0);
    EXPECT_EQ(l.printed_value, "50000838");
    EXPECT_EQ(l.scope_entry, "L1");
    EXPECT_NEAR(*l.capability, std::sqrt(50.0 * 50.0 + 25.0 * 25.0), 1e-3);
    EXPECT_EQ(l.printed_U, evaluation.record.results.at(0).printed.U);
    EXPECT_EQ(l.verdict->verdict, "pass");
}

TEST(EvaluateJob, MakesNoCertificateWithoutCertificateData) {
    const Evaluation evaluation =
        evaluate_job(k_sources / "examples/end_gauge/job.json", CovarianceFile::none, 1, k_sources / "templates");
    EXPECT_FALSE(evaluation.record.certificate);
    EXPECT_FALSE(evaluation.blocked);
}

}  // namespace
}  // namespace gumcert::evaluation
