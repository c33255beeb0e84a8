#include "jobs/certificate/certificate_statement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "jobs/certificate/certificate_archive.h"
#include "jobs/certificate/certificate_codes.h"
#include "jobs/file_source.h"
#include "jobs/image_format.h"
#include "jobs/rotary_table/rotary_table_job.h"
#include "tests/support/bad_certificate_data.h"
#include "tests/support/budget_campaign.h"
#include "tests/support/campaign.h"
#include "tests/support/certificate_json.h"

namespace gumcert::jobs {
namespace {

using certificate::CertificateData;
using nlohmann::json;
using test::bad_certificate_data;
using test::BadData;
using test::CertificateJsonWriter;
using testing::ElementsAre;
using testing::HasSubstr;

/// The picture of the sample: 16 × 16 pixels, grey.
std::string sample_png() {
    static const std::string k_letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    unsigned bits = 0;
    int count = 0;
    for (const char c : gumcert::test::sample_accreditation().symbol_base64) {
        if (c == '=') {
            break;
        }
        bits = bits << 6U | static_cast<unsigned>(k_letters.find(c));
        count += 6;
        if (count >= 8) {
            count -= 8;
            bytes += static_cast<char>((bits >> static_cast<unsigned>(count)) & 0xFFU);
        }
    }
    return bytes;
}

using Files = std::map<std::string, std::string>;

/// A length at one point, with what the limits of the complete data refer to.
const std::string k_length =
    R"("inputs": {"l": {"value": 1, "u": 0.1}}, "sections": {"length": {"outputs": {"l": {}}, "points": {
        "columns": {"range": "text", "nominal": "mm", "V_s": "mm", "L_n": "mm"},
        "list": [{"l": 1, "range": "10 V", "nominal": 50, "V_s": 50, "L_n": 5}]}}})";

/// Certificate data in a file beside a small budget job.
CertificateData read(const std::string& data, Files files = {}) {
    files["job.json"] = test::budget_text(k_length + R"(, "certificate": "certificate.json")");
    files.emplace("symbol.png", sample_png());
    files.emplace("earlier.json", "{}");
    files["certificate.json"] = data;
    return read_budget_job(MemoryFileSource(files), "job.json").certificate.value();
}

CertificateData read(const json& data, const Files& files = {}) {
    return read(data.dump(1), files);
}

template <class Data>
std::vector<gum::Diagnostic> refusals(const Data& data, const Files& files = {}) {
    try {
        (void)read(data, files);
    } catch (const gum::InputError& error) {
        return error.diagnostics();
    }
    return {};
}

json complete() {
    return CertificateJsonWriter::structure(test::complete_certificate_data());
}

TEST(CertificateStatement, ReadsEverything) {
    const CertificateData data = read(complete());
    EXPECT_EQ(CertificateJsonWriter::structure(data), complete());
    ASSERT_TRUE(data.accreditation);
    const certificate::Accreditation expected = gumcert::test::sample_accreditation();
    EXPECT_EQ(data.accreditation->symbol_sha256, expected.symbol_sha256);
    EXPECT_EQ(data.accreditation->symbol_media_type, "image/png");
    EXPECT_EQ(data.accreditation->symbol_base64, expected.symbol_base64);
    EXPECT_FALSE(data.own_profile);
}

TEST(CertificateStatement, ReadsTheObjectInAJob) {
    const BudgetJob job = test::read_budget(k_length + R"(, "certificate": )" + complete().dump(),
                                            {{"symbol.png", sample_png()}, {"earlier.json", "{}"}});
    ASSERT_TRUE(job.certificate);
    EXPECT_EQ(CertificateJsonWriter::structure(*job.certificate), complete());
    EXPECT_THAT(job.files, ElementsAre("job.json", "symbol.png", "earlier.json"));
    EXPECT_FALSE(test::read_budget(R"("inputs": {"l": {"value": 1, "u": 0.1}})").certificate);
}

TEST(CertificateStatement, NamesTheFilesOfTheJob) {
    Files files{{"job.json", test::budget_text(R"("inputs": {"l": {"value": 1, "u": 0.1}},
                     "certificate": "certificate.json")")},
                {"certificate.json", R"({"profile": "own.json", "accreditation": {"symbol_file": "symbol.png"}})"},
                {"own.json", R"({"id": "own", "name": "Own"})"},
                {"symbol.png", sample_png()}};
    EXPECT_THAT(read_budget_job(MemoryFileSource(files), "job.json").files,
                ElementsAre("job.json", "certificate.json", "symbol.png", "own.json"));
    files.erase("symbol.png");
    EXPECT_THROW(static_cast<void>(read_budget_job(MemoryFileSource(files), "job.json")), gum::StorageError);
}

TEST(CertificateStatement, KnowsTheSectionsOfTheJob) {
    const auto told = [](const json& sections) {
        std::vector<std::string> codes;
        for (const gum::Diagnostic& one : refusals(json{{"sections", sections}})) {
            codes.push_back(one.code);
        }
        return codes;
    };
    EXPECT_THAT(told({{{"section", "length"}}}), testing::IsEmpty());
    EXPECT_THAT(told({{{"section", "width"}}}), ElementsAre("GC-CERT-0125"));
    EXPECT_THAT(told({{{"section", "length"}, {"standards", {"STD-9"}}}}), ElementsAre("GC-CERT-0125"));
    EXPECT_THAT(told({{{"section", "length"}}, {{"section", "length"}}}), ElementsAre("GC-CERT-0114"));
}

TEST(CertificateStatement, NeedsNothing) {
    const CertificateData data = read(std::string("{}"));
    EXPECT_EQ(data.status, "specimen");
    EXPECT_THAT(data.languages, ElementsAre("en"));
    EXPECT_EQ(data.profile, "ilac");
    EXPECT_FALSE(data.accreditation);
    EXPECT_TRUE(data.standards.empty());
}

TEST(CertificateStatement, StatusFollowsTheAccreditation) {
    EXPECT_EQ(read(std::string(R"({"accreditation": {}})")).status, "accredited");
    EXPECT_EQ(read(std::string(R"({"accreditation": {}, "status": "specimen"})")).status, "specimen");
    EXPECT_EQ(read(std::string(R"({"status": "not_accredited"})")).status, "not_accredited");
}

TEST(CertificateStatement, TextsAreForAllLanguagesOrForEach) {
    const CertificateData data = read(
        std::string(R"({"sampling": "S", "item": {"description": {"es": "Mesa", "zh-Hant": "轉台", "en": "Table"}}})"));
    EXPECT_EQ(data.sampling.in("de"), "S");
    const certificate::LocalisedText& text = data.item.description;
    EXPECT_EQ(text.in("zh-Hant"), "轉台");
    EXPECT_EQ(text.in("de"), "Table") << "the first language in the order of the program";
    ASSERT_EQ(text.by_language.size(), 3U);
    EXPECT_EQ(text.by_language.back().first, "es");
}

// What could be markup is text; the forms of a certificate escape it.
TEST(CertificateStatement, TheTitleOfAJobIsOneTextOrOneInEachLanguage) {
    std::size_t refusals = 0;
    const auto title_of = [&](const std::string& text) {
        static constexpr std::array<std::string_view, 1> k_keys{"title"};
        ProblemList problems("job.json");
        const JsonDocument document = parse_json_document(text, "job.json");
        certificate::LocalisedText title;
        read_title(JsonObject(document, "", k_keys, problems), {&document, "/title", &problems}, title);
        refusals = problems.refusals();
        return title;
    };
    EXPECT_EQ(title_of(R"({"title": "Multimeter"})"), certificate::LocalisedText("Multimeter"));
    EXPECT_EQ(title_of(R"({"title": {"de": "Messgerät", "es": "Aparato"}})").in("es"), "Aparato");
    EXPECT_TRUE(title_of("{}").empty());
    EXPECT_EQ(refusals, 0U);
    for (const char* wrong : {R"({"title": 1})", R"({"title": ""})", R"({"title": {}})", R"({"title": {"fr": "x"}})"}) {
        EXPECT_TRUE(title_of(wrong).empty()) << wrong;
        EXPECT_EQ(refusals, 1U) << wrong;
    }
}

TEST(CertificateStatement, TakesTextsAsTheyAre) {
    for (const std::string text :
         {"<script>alert(1)</script>", "{{laboratory}}", "url(file:///etc/passwd)", "]]>", "&amp;", "מעבדה", "مختبر",
          "実験室", "a' OR '1'='1", "\\input{x}", "#include \"x\""}) {
        const json data{{"remarks", {text}}, {"customer", {{"name", text}, {"order", text}}}};
        const CertificateData read_back = read(data);
        EXPECT_EQ(read_back.remarks.at(0).plain, text);
        EXPECT_EQ(read_back.customer.order, text);
    }
}

TEST(CertificateStatement, KeepsItsOwnProfile) {
    const Files files{{"own.json", R"({"id": "own", "name": {"x": 1}, "digits": 3})"}};
    const auto found = refusals(json{{"profile", "own.json"}}, files);
    ASSERT_EQ(found.size(), 2U) << test::texts(found);
    EXPECT_EQ(found[0].where, "own.json#/name (line 1, column 23)");
    EXPECT_EQ(found[1].where, "own.json#/digits (line 1, column 43)");
    const CertificateData data =
        read(json{{"profile", "own.json"}}, {{"own.json", R"({"id": "own", "name": "Own", "digits": 1})"}});
    ASSERT_TRUE(data.own_profile);
    EXPECT_EQ(data.own_profile->digits, 1);
    EXPECT_EQ(data.own_profile->name, "Own");
}

TEST(CertificateStatement, ReadsTheShippedExamples) {
    const std::filesystem::path folder = std::filesystem::path(GUMCERT_SOURCE_DIR) / "examples/certificate";
    const auto gauge = read_budget_job(folder / "end_gauge.json").certificate;
    ASSERT_TRUE(gauge);
    EXPECT_EQ(gauge->status, "accredited");
    EXPECT_EQ(gauge->accreditation->symbol_media_type, "image/png");
    EXPECT_EQ(gauge->specifications.at(0).rule.id, "DR-03");
    const auto table = read_rotary_table_job(folder / "rotary_table.json").certificate;
    ASSERT_TRUE(table);
    EXPECT_THAT(table->languages, ElementsAre("de", "en"));
    EXPECT_EQ(table->laboratory.name.in("de"), "Beispiel-Kalibrierlaboratorium");
}

class BadCertificateData : public testing::TestWithParam<BadData> {};

TEST_P(BadCertificateData, IsRefusedWithCodePlaceAndMessage) {
    const BadData& bad = GetParam();
    const auto found = refusals(bad.in(complete()));
    ASSERT_EQ(found.size(), 1U) << test::texts(found);
    EXPECT_EQ(found[0].code, bad.code.code);
    EXPECT_THAT(found[0].where,
                testing::StartsWith("certificate.json#" + (bad.place.empty() ? bad.pointer : bad.place) +
                                    (bad.pointer == "/languages" ? "" : " (")));
    EXPECT_THAT(gum::message(found[0]), HasSubstr(bad.message));
    EXPECT_FALSE(found[0].rule.empty());
    EXPECT_FALSE(found[0].action.empty());
    EXPECT_THAT(gum::message(found[0]), testing::Not(HasSubstr("\n")));
}

INSTANTIATE_TEST_SUITE_P(Rows, BadCertificateData, testing::ValuesIn(bad_certificate_data()),
                         [](const auto& row) { return row.param.name; });

TEST(CertificateStatement, EveryCodeHasABadInput) {
    std::set<std::string_view> covered{k_certificate_no_limit.code, k_certificate_capability.code,
                                       k_certificate_symbol.code, k_certificate_placeholder.code};  // by tests below
    for (const BadData& bad : bad_certificate_data()) {
        covered.insert(bad.code.code);
    }
    for (const InputCode& code : k_certificate_codes) {
        EXPECT_TRUE(covered.contains(code.code)) << code.code << " " << code.meaning;
    }
}

TEST(CertificateStatement, ASpecificationHasALimit) {
    json data = complete();
    data["specifications"][0].erase("lower");
    data["specifications"][0].erase("upper");
    const auto found = refusals(data);
    ASSERT_EQ(found.size(), 1U) << test::texts(found);
    EXPECT_EQ(found[0].code, k_certificate_no_limit.code);
    EXPECT_THAT(found[0].where, HasSubstr("#/specifications/0 ("));
    data["specifications"][0]["upper"] = 1.0;
    EXPECT_EQ(test::texts(refusals(data)), "");
}

TEST(CertificateStatement, ACapabilityMustBeUsable) {
    json data = complete();
    json& capability = data["accreditation"]["scope"][1]["capability"];
    ASSERT_EQ(capability["form"], "value");
    capability["U"] = 0;
    const auto found = refusals(data);
    ASSERT_FALSE(found.empty());
    EXPECT_EQ(found[0].code, k_certificate_capability.code);
    EXPECT_THAT(found[0].where, HasSubstr("#/accreditation/scope/1/capability"));
}

TEST(CertificateStatement, FindsAllProblemsTogether) {
    const auto found = refusals(std::string(R"({
  "number": 1,
  "number": "2",
  "dates": {"issued": "2026-13-01", "received": "yesterday"},
  "standards": [{"name": "Laser", "U": -1, "unit": "um"}, {"U": 1}],
  "languages": ["en", "xx"]
})"));
    std::vector<std::string> places;
    for (const gum::Diagnostic& d : found) {
        places.push_back(d.code + " " + d.where);
    }
    EXPECT_THAT(places,
                testing::UnorderedElementsAre("GC-INPUT-0012 certificate.json#/number (line 3, column 3)",
                                              "GC-CERT-0103 certificate.json#/number (line 2, column 13)",
                                              "GC-CERT-0107 certificate.json#/dates/issued (line 4, column 23)",
                                              "GC-CERT-0107 certificate.json#/dates/received (line 4, column 49)",
                                              "GC-CERT-0104 certificate.json#/standards/0/U (line 5, column 40)",
                                              "GC-CERT-0102 certificate.json#/standards/1 (line 5, column 59)",
                                              "GC-CERT-0111 certificate.json#/languages/1 (line 6, column 23)"));
}

TEST(CertificateStatement, RefusesTheWrongTypeOfEveryKeyAtItsPlace) {
    const json whole = complete();
    std::size_t count = 0;
    const auto walk = [&](const auto& self, const json& node, const std::string& pointer) -> void {
        for (const auto& [key, value] : node.items()) {
            const std::string at = pointer + "/" + key;
            json wrong = whole;
            wrong[json::json_pointer(at)] = json::array({json::array()});
            const auto found = refusals(wrong);
            EXPECT_TRUE(std::any_of(found.begin(), found.end(),
                                    [&](const auto& d) {
                                        return d.where.find("#" + at + " (") != std::string::npos ||
                                               d.where.find("#" + at + "/0") != std::string::npos;
                                    }))
                << at << "\n"
                << test::texts(found);
            ++count;
            if (value.is_structured()) {
                self(self, value, at);
            }
        }
    };
    walk(walk, whole, "");
    EXPECT_GT(count, 250U);
}

TEST(CertificateStatement, SymbolIsAPicture) {
    const json data{{"accreditation", {{"symbol_file", "symbol"}}}};
    const std::string png = sample_png();
    const auto with = [&](const std::string& bytes) { return refusals(data, {{"symbol", bytes}}); };
    EXPECT_EQ(test::texts(with(png)), "");
    const std::string jpeg{
        "\xFF\xD8\xFF\xE0\x00\x04\x00\x00\xFF\xC0\x00\x0B\x08\x00\x10\x00\x20\x01\x01\x11\x00"
        "\xFF\xDA\x00\x08\x01\x01\x00\x00\x3F\x00\x55\xFF\xD9",
        34};
    EXPECT_EQ(test::texts(with(jpeg)), "");
    EXPECT_EQ(read(data, {{"symbol", jpeg}}).accreditation->symbol_media_type, "image/jpeg");
    std::string huge = png;
    huge.replace(16, 4, std::string("\x00\x00\x40\x00", 4));
    const std::vector<std::pair<std::string, std::string>> bad{
        {"<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 1 1\"><script/></svg>", "the element \"script\""},
        {"<?xml version=\"1.0\"?><!-- --><svg/>", "without its namespace"},
        {"GIF89a", "of another format"},
        {"", "an empty file"},
        {png.substr(0, png.size() - 5), "a PNG file that is cut off"},
        {png + "<script>", "bytes after its end"},
        {png.substr(0, 33) + png.substr(png.size() - 12), "without pixels"},
        {huge, "an image of 16384 by 16 pixels"},
        {jpeg.substr(0, 30), "a JPEG file that is cut off"},
        {jpeg.substr(0, 8) + jpeg.substr(21), "a JPEG file that is cut off"},
        {png + std::string(1U << 20U, ' '), "at most 1 MiB"}};
    for (const auto& [bytes, message] : bad) {
        const auto found = with(bytes);
        ASSERT_EQ(found.size(), 1U) << message << "\n" << test::texts(found);
        EXPECT_EQ(found[0].code, k_certificate_symbol.code);
        EXPECT_EQ(found[0].where, "symbol");
        EXPECT_THAT(gum::message(found[0]), HasSubstr(message));
    }
}

TEST(CertificateStatement, LogoIsAPicture) {
    const json data{{"laboratory", {{"logo", "logo"}}}};
    const std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 1 1\"/>";
    const certificate::Laboratory drawn = read(data, {{"logo", svg}}).laboratory;
    EXPECT_EQ(drawn.logo_media_type, "image/svg+xml");
    EXPECT_EQ(drawn.logo_sha256.size(), 64U);
    EXPECT_EQ(drawn.logo_base64.substr(0, 8), "PHN2ZyB4");
    EXPECT_EQ(read(data, {{"logo", sample_png()}}).laboratory.logo_media_type, "image/png");
    const auto found = refusals(data, {{"logo", "<svg onload=\"a()\"/>"}});
    ASSERT_EQ(found.size(), 1U) << test::texts(found);
    EXPECT_EQ(found[0].code, k_certificate_symbol.code);
    EXPECT_THAT(found[0].what, HasSubstr("the attribute \"onload\""));
    EXPECT_THAT(found[0].rule, HasSubstr("the logo of a laboratory is"));
    EXPECT_TRUE(read(json{{"laboratory", {{"name", "A"}}}}).laboratory.logo_base64.empty());
    EXPECT_THAT(test::texts(refusals(json{{"laboratory", {{"logo_base64", "AAAA"}}}})), HasSubstr("logo_base64"))
        << "the program fills it in";
}

TEST(CertificateStatement, ReadsAnAddressByItsParts) {
    const CertificateData data = read(json{{"laboratory",
                                            {{"address",
                                              {{"street", "Example Street"},
                                               {"street_no", "1a"},
                                               {"post_office_box", "PO Box 7"},
                                               {"postcode", "12345"},
                                               {"city", "Example Town"},
                                               {"state", "Region"},
                                               {"country", "DE"}}}}}});
    const certificate::Address& address = data.laboratory.address;
    EXPECT_EQ(address.street + address.street_no + address.post_office_box, "Example Street1aPO Box 7");
    EXPECT_EQ(address.postcode + address.city + address.state + address.country, "12345Example TownRegionDE");
    EXPECT_THAT(address.lines, testing::IsEmpty());
}

TEST(ParseProfile, ReadsEveryKey) {
    const certificate::Profile profile = parse_profile(R"({"id": "own", "name": "Own body", "sources": ["D 1:2020"],
        "digits": 1, "rounding": "up", "below_capability": "outside", "mixed_results": "separate",
        "plus_minus_in_tables": false, "k_position": "column", "opinions_with_symbol": true,
        "reproduction_sentence_mandatory": false, "receipt_date_mandatory": true, "reviewer_may_be_performer": false,
        "required_languages": ["zh-Hant", "en"], "first_page_sentences": ["A", {"de": "B"}],
        "uncertainty_sentence": {"en": "k = {k} gives {coverage}."},
        "terms": [{"language": "es", "word": "medición", "term": "medida"}]})",
                                                       "own.json");
    EXPECT_EQ(profile.id, "own");
    EXPECT_THAT(profile.sources, ElementsAre("D 1:2020"));
    EXPECT_EQ(profile.digits, 1);
    EXPECT_EQ(profile.rounding, "up");
    EXPECT_EQ(profile.below_capability, "outside");
    EXPECT_EQ(profile.mixed_results, "separate");
    EXPECT_FALSE(profile.plus_minus_in_tables);
    EXPECT_EQ(profile.k_position, "column");
    EXPECT_TRUE(profile.opinions_with_symbol);
    EXPECT_FALSE(profile.reproduction_sentence_mandatory);
    EXPECT_TRUE(profile.receipt_date_mandatory);
    EXPECT_FALSE(profile.reviewer_may_be_performer);
    ASSERT_EQ(profile.terms.size(), 1U);
    EXPECT_EQ(profile.terms[0].language + profile.terms[0].word + profile.terms[0].term, "esmediciónmedida");
    EXPECT_THAT(profile.required_languages, ElementsAre("zh-Hant", "en"));
    ASSERT_EQ(profile.first_page_sentences.size(), 2U);
    EXPECT_EQ(profile.first_page_sentences[1].in("de"), "B");
    EXPECT_EQ(profile.uncertainty_sentence.in("en"), "k = {k} gives {coverage}.");
}

TEST(ParseProfile, RefusesWithEveryProblem) {
    try {
        (void)parse_profile(R"({"name": "n", "digits": 1.5, "rounding": "down", "colour": "red",
                               "required_languages": ["fr"], "uncertainty_sentence": ""})",
                            "bad.json");
        FAIL();
    } catch (const gum::InputError& error) {
        std::vector<std::string> codes;
        for (const gum::Diagnostic& d : error.diagnostics()) {
            codes.push_back(d.code);
        }
        EXPECT_THAT(codes, ElementsAre("GC-CERT-0102", "GC-CERT-0104", "GC-CERT-0106", "GC-CERT-0111", "GC-CERT-0101"))
            << test::texts(error.diagnostics());
    }
    for (const char* const text : {"", "[]", "3", "{\"id\": \"a\", \"name\": \"n\", \"uncertainty_sentence\": \"{K}\"}",
                                   "{\"id\": \"a\", \"name\": \"n\", \"uncertainty_sentence\": {\"en\": \"{k\"}}"}) {
        EXPECT_THROW(static_cast<void>(parse_profile(text, "bad.json")), gum::InputError) << text;
    }
}

TEST(ParseProfile, ReadsTheProfilesOfTheTree) {
    std::size_t count = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(GUMCERT_SOURCE_DIR) / "templates/profiles")) {
        if (entry.path().extension() != ".json") {
            continue;
        }
        std::ifstream stream(entry.path(), std::ios::binary);
        const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
        try {
            EXPECT_EQ(parse_profile(text, entry.path().filename().string()).id, entry.path().stem().string());
        } catch (const gum::InputError& error) {
            ADD_FAILURE() << test::texts(error.diagnostics());
        }
        ++count;
    }
    EXPECT_GT(count, 0U);
}

}  // namespace
}  // namespace gumcert::jobs
