#include "reports/deviations.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reports/forms/asset_files.h"
#include "tests/unit/reports/document_text.h"

#include <nlohmann/json.hpp>

namespace gumcert::reports {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::string> in_words(const certificate::CertificateData& data, const std::string& language) {
    RenderAssets in = assets();
    in.languages = {language};
    std::vector<std::string> texts;
    for (const Text& text : deviations_in_words(read_wording(in), data)) {
        texts.push_back(text.first());
    }
    return texts;
}

TEST(Deviations, AreThoseOfTheMethodAndWhatSomebodyAccepted) {
    certificate::CertificateData data;
    EXPECT_THAT(in_words(data, "en"), IsEmpty());
    data.method.deviations = {"Three readings in place of five."};
    data.waivers = {{.finding = "U10",
                     .where = {},
                     .by = "Head of laboratory",
                     .date = "2026-11-20",
                     .reason = "The maker states it so, in writing."},
                    {.finding = "U11", .where = {}, .by = "-", .date = "2026-11-20", .reason = "-"}};
    EXPECT_THAT(in_words(data, "en"),
                ElementsAre("Three readings in place of five.",
                            "Finding U10 of the audit is accepted by Head of laboratory, 2026-11-20: The maker states "
                            "it so, in writing."))
        << "a waiver without person and reason has no effect";
    EXPECT_EQ(in_words(data, "de").back(),
              "Feststellung U10 des Audits, angenommen von Head of laboratory, 2026-11-20: The maker states it so, in "
              "writing.");
}

}  // namespace
}  // namespace gumcert::reports
