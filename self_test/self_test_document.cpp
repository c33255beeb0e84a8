#include "self_test/self_test_document.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "reports/forms/asset_files.h"
#include "reports/forms/document_forms.h"
#include "reports/printable_text.h"
#include "reports/view/certificate_builder.h"
#include "reports/wording.h"

namespace gumcert::self_test {

namespace {

using nlohmann::json;
using reports::Facts;
using reports::Rows;
using reports::Text;
using reports::Wording;

constexpr int k_more_digits = 3;  // of a computed number than of the expected one
constexpr std::size_t k_longest_because = 160;

class SelfTestPages {
public:
    SelfTestPages(const SelfTest& test, std::string digest, const Wording& wording)
        : test_(test), digest_(std::move(digest)), words_(wording), builder_(wording) {}

    json view() {
        what_was_tested();
        disagreements();
        cases();
        values();
        not_compared();
        libraries();
        const bool passes = test_.passed() == test_.cases.size();
        const Text mark =
            filled(passes ? "passed" : "failed", {{"count", std::to_string(test_.cases.size())},
                                                  {"failed", std::to_string(test_.cases.size() - test_.passed())}});
        const std::string title = program();
        json page = {{"language", words_.language()},
                     {"mark", json::array({{{"text", mark.first()},
                                            {"also", json::array()},
                                            {"reason", word("mark_reason").first()},
                                            {"reason_also", json::array()}}})},
                     {"running_title", title},
                     {"header_left", title + " · " + test_.system.date},
                     {"header_right", mark.first()},
                     {"footer_left", "SHA-256 " + digest_},
                     {"pages", json::array({{{"page", words_("document", "page").first()},
                                             {"of", words_("document", "of").first()},
                                             {"end", words_("document", "page_end").first()}}})},
                     {"identity", json::array()},
                     {"closing", json::array({{{"text", word("only_items").first()}, {"also", json::array()}}})},
                     {"attachment", json::array()},
                     {"sections", builder_.take()}};
        put(page, "type", word("title"), words_.languages());
        put(page, "title", Text(title + " (" + test_.system.commit + ")"), words_.languages());
        put(page, "end_mark", word("end_mark"), words_.languages());
        return page;
    }

private:
    const SelfTest& test_;
    std::string digest_;
    const Wording& words_;
    reports::CertificateBuilder builder_;

    [[nodiscard]] Text word(const std::string& name) const { return words_("self_test", name); }
    [[nodiscard]] Text filled(const std::string& name, const Wording::Values& values) const {
        return words_.filled("self_test", name, values);
    }
    [[nodiscard]] std::string program() const { return test_.system.name + " " + test_.system.version; }

    [[nodiscard]] Text with_release(const std::string& digest, bool of_release) const {
        return Text(digest + " · ") + word(of_release ? "of_release" : "changed");
    }

    [[nodiscard]] Text result(bool agrees) const { return word(agrees ? "agrees" : "disagrees"); }

    [[nodiscard]] Text source(const ReferenceCase& reference) const {
        std::string text = reference.document;
        if (!reference.place.empty()) {
            text += ", " + reference.place;
        }
        return reference.is_place_seen ? Text(text) : Text(text) + " (" + word("place_unseen") + ")";
    }

    void what_was_tested() {
        builder_.section("tested", word("section_tested"));
        Facts facts;
        const TestedSystem& system = test_.system;
        add_fact(facts, word("date"), system.date);
        add_fact(facts, word("program"), program() + ", " + system.commit);
        add_fact(facts, word("executable"), system.executable_sha256);
        add_fact(facts, word("processor"), system.processor);
        add_fact(facts, word("operating_system"), system.operating_system);
        add_fact(facts, word("compiler"), system.compiler);
        add_fact(facts, word("cases"),
                 filled("count_of_values", {{"cases", std::to_string(test_.cases.size())},
                                            {"passed", std::to_string(test_.passed())},
                                            {"values", std::to_string(test_.compared())},
                                            {"agreed", std::to_string(test_.agreed())}}));
        add_fact(facts, word("cases_digest"), with_release(test_.cases_sha256, system.cases_of_release));
        add_fact(facts, word("templates"), with_release(system.templates_sha256, system.templates_of_release));
        add_fact(facts, word("unit_table"), Text(test_.unit_table_sha256 + " · ") + word("in_the_program"));
        std::string fonts;
        for (const std::string& font : system.fonts) {
            fonts += (fonts.empty() ? "" : ", ") + font;
        }
        add_fact(facts, word("fonts"), fonts);
        add_fact(facts, word("digest"), digest_);
        builder_.definitions(facts);
        builder_.paragraph(word("what_it_shows"));
        builder_.paragraph(word("what_it_does_not_show"));
    }

    void disagreements() {
        if (test_.passed() == test_.cases.size()) {
            return;
        }
        builder_.section("disagreements", word("section_disagreements"));
        Rows rows;
        for (const CaseOutcome& outcome : test_.cases) {
            if (!outcome.refused.empty()) {
                rows.push_back({outcome.reference.id, "", outcome.refused});
            }
            for (const ComparedValue& value : outcome.values) {
                if (!value.agrees) {
                    rows.push_back({outcome.reference.id, value.expected.name(),
                                    reports::shortened(value.because, k_longest_because)});
                }
            }
        }
        builder_.table("disagreements", word("disagreements_caption"),
                       {{word("case")}, {word("quantity")}, {word("because")}}, rows);
        builder_.paragraph(word("what_to_do"));
    }

    /// Digits of the value that lacks the most of those that are expected of it.
    [[nodiscard]] Text worst_digits(const CaseOutcome& outcome) const {
        const ComparedValue* worst = nullptr;
        int most = 0;
        bool has_numbers = false;
        for (const ComparedValue& value : outcome.values) {
            const int digits = value.expected.digits();
            has_numbers = has_numbers || digits > 0;
            if (digits - value.digits_reached > most) {
                most = digits - value.digits_reached;
                worst = &value;
            }
        }
        return worst != nullptr ? Text(digits_of(*worst)) : has_numbers ? word("all_digits") : Text();
    }

    [[nodiscard]] static std::string digits_of(const ComparedValue& value) {
        const int digits = value.expected.digits();
        return digits == 0 ? "" : std::to_string(value.digits_reached) + "/" + std::to_string(digits);
    }

    void cases() {
        builder_.section("cases", word("section_cases"));
        builder_.paragraph(word("about_sources"));
        builder_.paragraph(word("about_digits"));
        Rows rows;
        for (const CaseOutcome& outcome : test_.cases) {
            const ReferenceCase& reference = outcome.reference;
            const bool seen = !reference.seen.empty();
            rows.push_back({reference.title.empty() ? reference.id : reference.id + ": " + reference.title,
                            source(reference), seen ? words_("self_test", "seen", reference.seen) : Text(),
                            std::to_string(outcome.agreed()) + "/" + std::to_string(outcome.values.size()),
                            worst_digits(outcome), result(outcome.passes())});
        }
        builder_.table("cases", word("cases_caption"),
                       {{word("case")},
                        {word("source")},
                        {word("seen_head")},
                        {word("values_head")},
                        {word("worst_digits")},
                        {word("result")}},
                       rows);
    }

    void values() {
        std::map<std::string, std::vector<const CaseOutcome*>> topics;
        for (const CaseOutcome& outcome : test_.cases) {
            topics[outcome.reference.topic].push_back(&outcome);
        }
        builder_.annexes();
        std::size_t number = 0;
        for (const auto& [topic, outcomes] : topics) {
            Rows rows;
            for (const CaseOutcome* const outcome : outcomes) {
                for (const ComparedValue& value : outcome->values) {
                    const ExpectedValue& expected = value.expected;
                    const int digits = expected.digits();
                    rows.push_back(
                        {outcome->reference.id, expected.name(),
                         expected.is_printed ? Text(expected.text) : Text(expected.text + " ") + word("independent"),
                         value.was_found ? value_text(value.computed, std::min(digits + k_more_digits, 17)) : "",
                         value.tolerance ? value_text(*value.tolerance, 2) : "", digits_of(value),
                         result(value.agrees)});
                }
            }
            if (rows.empty()) {
                continue;
            }
            builder_.section("values-" + std::to_string(++number), filled("section_values", {{"topic", topic}}));
            builder_.table("values-" + std::to_string(number), filled("values_caption", {{"topic", topic}}),
                           {{word("case")},
                            {word("quantity")},
                            {word("expected")},
                            {word("computed")},
                            {word("tolerance")},
                            {word("digits")},
                            {word("result")}},
                           rows);
        }
    }

    void not_compared() {
        Rows rows;
        for (const CaseOutcome& outcome : test_.cases) {
            for (const ExpectedValue& expected : outcome.reference.expected) {
                if (!expected.not_compared.empty()) {
                    rows.push_back({outcome.reference.id, expected.name(), expected.text, expected.not_compared});
                }
            }
        }
        if (rows.empty()) {
            return;
        }
        builder_.section("not-compared", word("section_not_compared"));
        builder_.table("not-compared", word("not_compared_caption"),
                       {{word("case")}, {word("quantity")}, {word("expected")}, {word("because")}}, rows);
    }

    void libraries() {
        builder_.section("libraries", word("section_libraries"));
        Rows rows;
        for (const LibraryVersion& library : test_.system.libraries) {
            rows.push_back({library.name, library.version,
                            library.sha256.empty() ? word("in_the_program") : Text(library.sha256)});
        }
        builder_.table("libraries", word("libraries_caption"), {{word("library")}, {word("version")}, {"SHA-256"}},
                       rows);
    }
};

json view_of(const SelfTest& test, const std::string& digest, const reports::RenderAssets& one_language) {
    const Wording wording = reports::read_wording(one_language);
    return SelfTestPages(test, digest, wording).view();
}

}  // namespace

std::string self_test_html(const SelfTest& test, const std::string& digest, const reports::RenderAssets& assets) {
    const reports::RenderAssets one_language = in_one_language(assets);
    return view_as_html(view_of(test, digest, one_language), one_language);
}

std::string self_test_pdf(const SelfTest& test, const std::string& digest, const reports::RenderAssets& assets) {
    const reports::RenderAssets one_language = in_one_language(assets);
    return view_as_pdf(view_of(test, digest, one_language), one_language);
}

}  // namespace gumcert::self_test
