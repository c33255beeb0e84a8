#include "archive/certificates/archive_draft.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <new>
#include <nlohmann/json.hpp>
#include <utility>

#include "archive/certificates/report_changes.h"
#include "archive/head.h"
#include "archive/names.h"
#include "archive/printed_head.h"
#include "certificate/dates.h"
#include "certificate/gates/day_of_issue.h"
#include "certificate/section_data.h"
#include "certificate/stated_text.h"
#include "encoding/sha2.h"
#include "evaluation/read_file.h"
#include "evaluation/recompute_record.h"
#include "imports/foreign_certificate.h"
#include "issuing/document_identity.h"
#include "outputs/output_set.h"
#include "reports/agreement/dcc_agreement.h"
#include "reports/agreement/document_agreement.h"
#include "reports/agreement/document_facts.h"
#include "reports/agreement/document_words.h"
#include "reports/dcc/dcc_document.h"
#include "reports/forms/asset_files.h"
#include "reports/forms/document_forms.h"
#include "reports/forms/html_texts.h"
#include "reports/forms/pdf_other_parts.h"
#include "reports/forms/pdf_page_texts.h"
#include "reports/forms/render.h"
#include "reports/printable_text.h"
#include "reports/record/make/certificate/amended_record.h"
#include "signing/verify.h"
#include "text/lists.h"
#include "text/visible_text.h"

namespace gumcert::archive {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_document(const fs::path& file, std::string what, std::string rule, std::string action) {
    throw gum::InputError(gum::Diagnostic{.code = "GC-ARCHIVE-0029",
                                          .where = file.string(),
                                          .what = std::move(what),
                                          .rule = std::move(rule),
                                          .action = std::move(action)});
}

[[noreturn]] void refuse_as_other(const fs::path& file, const std::string& number, const std::string& wanted) {
    refuse_document(
        file,
        number.empty() ? "does not say which certificate it is" : "is a document of certificate \"" + number + "\"",
        "documents belong to the record, which is that of \"" + wanted + "\"",
        "name the documents that were made of this record");
}

/// Whether a remark is for whoever takes values out of a certificate. Here each element is compared with that of the record.
bool says_what_import_leaves_out(const gum::Diagnostic& one) {
    const bool is_of_reading = one.code.starts_with("GC-DCC-00") && one.code < "GC-DCC-0040";
    return one.severity != gum::Severity::error && (is_of_reading || one.code.starts_with("GC-DCC-01"));
}

/// Keeps remarks, and refuses with all errors together.
class CheckFindings {
public:
    void take(std::vector<gum::Diagnostic> found) {
        for (gum::Diagnostic& one : found) {
            (one.severity == gum::Severity::error ? errors_ : remarks_).push_back(std::move(one));
        }
    }
    [[nodiscard]] std::vector<gum::Diagnostic> remarks() && {
        if (!errors_.empty()) {
            throw gum::InputError(std::move(errors_));
        }
        return std::move(remarks_);
    }

private:
    std::vector<gum::Diagnostic> errors_, remarks_;
};

/// Signatures, as far as they can be judged: without a trust store it is not asked who the signer is, and said so, as of a
/// digital certificate.
void check_pdf_signatures(const fs::path& file, const signing::Verification& verification, bool trust_named,
                          CheckFindings& findings) {
    std::vector<gum::Diagnostic> signers;
    for (const auto* signatures : {&verification.signatures, &verification.attachment_signatures}) {
        for (const signing::SignatureReport& signature : *signatures) {
            std::vector<gum::Diagnostic> found = signature.findings;
            if (!trust_named) {
                std::erase_if(found, [](const gum::Diagnostic& one) {
                    return one.code == "GC-SIGN-0130" || one.code == "GC-SIGN-0133";
                });
            }
            findings.take(std::move(found));
            const std::string signer = signature.signer.empty() ? "a signer that is not stated" : signature.signer;
            gum::Diagnostic unknown{
                .code = "GC-DCC-0043",
                .where = file.string(),
                .what = "signed by " + signer + "; the document is as it was signed, who the signer is was not checked",
                .rule = "a signer is known by a certificate that you trust",
                .action = "name such certificates with --trust",
                .severity = gum::Severity::warning};
            const bool is_told = std::any_of(signers.begin(), signers.end(),
                                             [&](const gum::Diagnostic& one) { return one.what == unknown.what; });
            if (!trust_named && !is_told) {
                signers.push_back(std::move(unknown));
            }
        }
    }
    findings.take(std::move(signers));
}

/// Holds documents against the record that they are said to be made of.
class DocumentsOfRecord {
public:
    DocumentsOfRecord(const reports::EvaluationRecord& record, const ArchiveChecks& checks)
        : record_(record),
          checks_(checks),
          identity_(stated_identity(record)),
          number_(identity_.number),
          words_(reports::document_words(reports::read_every_wording(checks.templates))) {
        assets_.templates = checks.templates;
    }

    Document checked(const fs::path& file, CheckFindings& findings) {
        Document document{.name = file.filename().string(), .media_type = {}, .bytes = evaluation::read_file(file)};
        require_as_written(file, document.bytes, findings);
        const std::string_view bytes = document.bytes;
        const std::string_view start = bytes.substr(0, bytes.find_first_of("\r\n"));
        if (start.starts_with("<!DOCTYPE html") || start.starts_with("<!doctype html")) {
            document.media_type = "text/html";
            if (!reports::says_number(document.bytes, number_)) {
                refuse_as_other(file, "", number_);
            }
            require_nothing_hidden(file, bytes);
            const std::string text = reports::text_of_html(bytes);
            const reports::PrintedDocument page({text});
            require_agreement(file, page);
            if (page.names_other_templates(words_)) {
                findings.take({what_was_compared(file)});
            } else {
                require_style_of_templates(file, bytes);
                require_same_page(file, bytes);
            }
            return document;
        }
        const bool is_pdf = bytes.starts_with("%PDF-");
        if (!is_pdf && !start.starts_with('<') && !start.starts_with("\xEF\xBB\xBF<")) {
            refuse_document(file, "is neither a PDF, nor a digital certificate, nor HTML",
                            "an archive keeps records and the documents that are made of them",
                            "name the documents that gumcert run or gumcert render has written");
        }
        const signing::Verification verification = signing::verify_signatures(
            document.bytes, file.string(), checks_.trusted.value_or(std::vector<signing::Bytes>()), checks_.now);
        if (is_pdf) {
            document.media_type = "application/pdf";
            // The report of a comparison has no such property: that each of its pages prints the number is asked below.
            const bool may_have_none = !record_.certificate && verification.pdf_keywords.empty();
            if (!may_have_none && reports::printable(verification.pdf_keywords) != number_) {
                refuse_as_other(file, verification.pdf_keywords, number_);
            }
            check_pdf_signatures(file, verification, checks_.trusted.has_value(), findings);
            require_nothing_beside_pages(file, bytes, verification, findings);
        } else {
            document.media_type = "application/xml";
            std::vector<gum::Diagnostic> found = imports::check_certificate(
                document.bytes, file.string(), {.trusted = checks_.trusted, .now = checks_.now});
            std::erase_if(found, says_what_import_leaves_out);
            findings.take(std::move(found));
        }
        const std::vector<issuing::DocumentIdentity> identities =
            issuing::identities_in(document.bytes, file.string(), verification);
        findings.take(issuing::doubts_about(file.string(), identities, verification));
        for (const issuing::DocumentIdentity& identity : identities) {
            if (identity.number != number_) {
                refuse_as_other(file, identity.number, number_);
            }
            if (!identity.state.empty()) {
                refuse_document(file, "is a " + identity.state, "what is issued are the documents as they are archived",
                                "mend what the findings of the record say, and make the documents anew");
            }
        }
        if (is_pdf) {
            require_agreement_of_pages(file, bytes);
            look_at_texts_beside_pages(file, bytes, findings);
            findings.take({what_was_compared(file)});
            signing::Verification alone;
            alone.kind = "dcc";
            for (const signing::Bytes& attachment : verification.attachments) {
                if (issuing::identities_in(attachment, file.string(), alone).empty()) {
                    refuse_document(file, "has an attached file that is no digital certificate",
                                    "an archive keeps records and the documents that are made of them",
                                    "make the document anew with gumcert render");
                }
                require_agreement_of_dcc(file, attachment);
            }
        } else {
            require_agreement_of_dcc(file, bytes);
        }
        return document;
    }

    /// Files that one command wrote together are not mixed with others.
    static void require_as_written(const fs::path& file, std::string_view bytes, CheckFindings& findings) {
        std::vector<gum::Diagnostic> doubts = outputs::doubts_about_set(file, bytes);
        for (gum::Diagnostic& doubt : doubts) {
            doubt.severity = gum::Severity::error;
        }
        findings.take(std::move(doubts));
    }

private:
    const reports::EvaluationRecord& record_;
    const ArchiveChecks& checks_;
    certificate::CertificateData identity_;
    std::string number_;
    reports::DocumentWords words_;
    reports::RenderAssets assets_;
    std::map<std::pair<std::vector<std::string>, std::string>, std::string>
        digital_certificates_;  // as the record gives them now, by languages and changed templates
    std::optional<reports::PrintedDocument> made_now_;  // the texts of its pages
    std::optional<std::string> style_;                  // of the templates

    static void refuse_disagreement(const fs::path& file, std::string what) {
        if (!what.empty()) {
            throw gum::InputError(gum::Diagnostic{
                .code = "GC-ARCHIVE-0038",
                .where = file.string(),
                .what = std::move(what),
                .rule = "a document states what its record states: whose certificate it is, values, units, "
                        "uncertainties, verdicts (ISO/IEC 17025:2017, 7.8.1.1)",
                .action =
                    "make the documents of this record with gumcert run or gumcert render, and add them together"});
        }
    }

    const std::string& style() {
        if (!style_) {
            style_ = evaluation::read_file(checks_.templates / "certificate.css");
        }
        return *style_;
    }

    [[noreturn]] static void refuse_page(const fs::path& file, const std::string& what) {
        throw gum::InputError(gum::Diagnostic{
            .code = "GC-ARCHIVE-0070",
            .where = file.string(),
            .what = what + ", and may show another text than it has",
            .rule = "what a page says is read from its text, and so it has to show all of its text and no other",
            .action = "make the page with the templates of this program, or add the PDF"});
    }

    void require_nothing_hidden(const fs::path& file, std::string_view html) {
        if (const std::string hidden = reports::hidden_part_of_html(html, style()); !hidden.empty()) {
            refuse_page(file, hidden);
        }
    }

    /// Pages of changed templates say so: this one is said to be of those of this program.
    void require_style_of_templates(const fs::path& file, std::string_view html) {
        if (!reports::has_style_of(html, style())) {
            refuse_page(file, "has another style sheet than the templates of this program, and names no changed ones");
        }
    }

    /// The pages show what they say: nothing lies over them, nothing is done by them, nothing else is with them.
    static void require_nothing_beside_pages(const fs::path& file, std::string_view pdf,
                                             const signing::Verification& verification, CheckFindings& findings) {
        reports::PdfOtherParts parts;
        try {
            parts = reports::other_parts_of_pdf(pdf);
        } catch (const std::bad_alloc&) {
            throw;  // says nothing of the document
        } catch (const std::exception& damaged) {
            refuse_document(file, std::string("its parts cannot be read: ") + damaged.what(),
                            "an archive keeps records and the documents that are made of them",
                            "make the document anew");
        }
        if (parts.refused.empty() && parts.attached_files > verification.attachments.size()) {
            parts.refused = "has an attached file that is no digital certificate";
        }
        if (!parts.refused.empty()) {
            throw gum::InputError(gum::Diagnostic{
                .code = "GC-ARCHIVE-0070",
                .where = file.string(),
                .what = parts.refused + ", and may show another text than it has",
                .rule = "what a page says is read from its text, and so it has to show all of its text and no other",
                .action = "make the PDF anew with gumcert render"});
        }
        if (parts.has_drawn_signature) {
            findings.take({gum::Diagnostic{
                .code = "GC-ARCHIVE-0071",
                .where = file.string(),
                .what = "a signature is drawn on its pages; not compared: what it shows, and what lies below it",
                .rule = "pages are made with any template and in any language, and what all of them print is compared",
                .action = "look at the pages when the certificate is reviewed",
                .severity = gum::Severity::note}});
        }
    }

    /// Said of each document of which not all was compared, so that nobody takes it for more than it is.
    static gum::Diagnostic what_was_compared(const fs::path& file) {
        return {
            .code = "GC-ARCHIVE-0071",
            .where = file.string(),
            .what =
                "compared with the record: number, laboratory, customer, item, dates, method, persons, standards, "
                "values with sign, unit, U and verdict; not compared: other texts, signs and units of other numbers, "
                "pictures, and what stands in a second place",
            .rule = "pages are made with any template and in any language, and what all of them print is compared",
            .action =
                "read them when the certificate is reviewed; of a digital certificate, and of HTML that is made with "
                "the templates of this program, everything is compared",
            .severity = gum::Severity::note};
    }

    /// A page that the templates of this program gave is the one that they give now, in its text and in every element and
    /// attribute: the record is of this version.
    void require_same_page(const fs::path& file, std::string_view bytes) {
        reports::RenderAssets assets = in_languages(file, reports::languages_of_html(bytes));
        assets.head = head_on_page(bytes, assets);
        const std::string made = reports::render_html(record_, assets);
        refuse_disagreement(file,
                            reports::difference_of_texts(reports::text_of_html(bytes), reports::text_of_html(made)));
        refuse_disagreement(file, reports::difference_of_texts(reports::structure_of_html(bytes),
                                                               reports::structure_of_html(made), "is made as "));
    }

    /// What a page prints of the head of an archive.
    static Head head_of(const PrintedHead& printed) {
        Head head;
        head.size = printed.size;
        head.root = printed.root;
        return head;
    }

    /// The head of an archive as a page prints it, with the place where it can be checked; none where it prints none. Whether
    /// it is one of this archive, the archive says.
    [[nodiscard]] std::optional<reports::HeadToPrint> head_on_page(std::string_view bytes,
                                                                   reports::RenderAssets assets) const {
        const std::vector<PrintedHead> printed = printed_heads_in(bytes);
        if (printed.empty()) {
            return std::nullopt;
        }
        const Head head = head_of(printed.front());
        reports::HeadToPrint asked{.entries = std::to_string(head.size),
                                   .digits = short_form(head),
                                   .mark = mark_of(head),
                                   .check_at = "WHERE-IT-CAN-BE-CHECKED"};
        // What stands around the place is found on a page that is made with another one.
        assets.head = asked;
        const std::string made = reports::render_html(record_, assets);
        const std::size_t at = made.find(asked.check_at);
        const std::size_t begin = at == std::string::npos ? at : made.rfind('>', at);
        const std::size_t end = at == std::string::npos ? at : made.find('<', at);
        const std::size_t length = asked.check_at.size();
        asked.check_at.clear();
        if (begin != std::string::npos && end != std::string::npos) {
            const std::string before = made.substr(begin, at - begin);
            const std::string behind = made.substr(at + length, end - at - length);
            const std::size_t sentence = bytes.find(before);
            const std::size_t from = sentence == std::string_view::npos ? bytes.size() : sentence + before.size();
            const std::string_view place = bytes.substr(from, std::min(bytes.find('<', from), bytes.size()) - from);
            if (place.ends_with(behind)) {
                asked.check_at = reports::text_of_html(place.substr(0, place.size() - behind.size()));
            }
        }
        return asked;
    }

    void require_agreement(const fs::path& file, const reports::PrintedDocument& document) {
        if (!made_now_) {
            made_now_.emplace(std::vector{reports::texts_of_view(reports::view_of_document(record_, assets_))});
        }
        refuse_disagreement(file, document.disagreement_with_facts(reports::facts_of(identity_), *made_now_));
        if (!record_.certificate || record_.certificate->tables.empty()) {
            refuse_disagreement(file, in_any_languages([&](const nlohmann::json& view) {
                                    return document.disagreement_with_report(view, words_);
                                }));
        } else {
            refuse_disagreement(file, document.disagreement_with(*record_.certificate, words_));
        }
    }

    [[nodiscard]] nlohmann::json view_in(const std::vector<std::string>& languages) const {
        reports::RenderAssets assets = assets_;
        assets.languages = languages;
        return reports::view_of_document(record_, assets);
    }

    /// A page does not say in which languages it is: the record may have been printed in any, or in any two side by side.
    /// \param disagreement  with a view, "" for none
    /// \return of the languages of the record, or "" where there is none in some language or two
    [[nodiscard]] std::string in_any_languages(
        const std::function<std::string(const nlohmann::json&)>& disagreement) const {
        std::string of_the_record = disagreement(reports::view_of_document(record_, assets_));
        const auto agrees_in = [&](const std::vector<std::string>& languages) {
            return disagreement(view_in(languages)).empty();
        };
        if (of_the_record.empty() || std::any_of(words_.languages.begin(), words_.languages.end(),
                                                 [&](const std::string& one) { return agrees_in({one}); })) {
            return {};
        }
        for (const std::string& first : words_.languages) {
            for (const std::string& second : words_.languages) {
                if (first != second && agrees_in({first, second})) {
                    return {};
                }
            }
        }
        return of_the_record;
    }

    void require_agreement_of_pages(const fs::path& file, std::string_view bytes) {
        std::vector<std::string> pages;
        try {
            pages = reports::drawn_texts_of_pages(bytes);
        } catch (const std::bad_alloc&) {
            throw;  // says nothing of the document
        } catch (const std::exception& damaged) {
            refuse_document(file, std::string("its pages cannot be read: ") + damaged.what(),
                            "an archive keeps records and the documents that are made of them",
                            "make the document anew");
        }
        const std::string number = reports::without_blanks(number_);
        const bool on_every_page = std::all_of(pages.begin(), pages.end(), [&](const std::string& page) {
            return reports::without_blanks(page).find(number) != std::string::npos;
        });
        refuse_disagreement(file, pages.empty()    ? "has no pages"
                                  : !on_every_page ? "does not print \"" + number_ + "\" on every page"
                                                   : "");
        const reports::PrintedDocument document(pages);
        if (!document.names_other_templates(words_)) {
            refuse_disagreement(file, document.disagreement_with_pages(words_));
        }
        require_agreement(file, document);
        // Each page was held against its view when it was made.
        std::string missing =
            in_any_languages([&](const nlohmann::json& view) { return document.disagreement_with_view(view); });
        refuse_disagreement(file, std::move(missing));
    }

    /// Bookmarks, properties and descriptions say what the pages print, or what the record gives in some language. What is copied and
    /// read aloud in place of what is drawn is the document to whoever does so.
    void look_at_texts_beside_pages(const fs::path& file, std::string_view bytes, CheckFindings& findings) {
        std::vector<reports::PdfTextBesidePages> texts = reports::other_parts_of_pdf(bytes).texts;
        for (reports::TextBesideDrawn& one : reports::texts_beside_drawn(bytes)) {
            texts.push_back({one.replaces ? "a text in place of what is drawn" : "a description", std::move(one.text),
                             one.replaces});
        }
        // One digit, sign or word in place of another one is among any others: what is drawn has nothing else in its place.
        std::string known;
        for (const std::string& page : reports::texts_of_pages(bytes)) {
            known += page + '\n';
        }
        std::erase_if(texts, [&](const reports::PdfTextBesidePages& one) {
            return says_only(one.text, known) || is_head_of_archive(one.text);
        });
        for (std::size_t i = 0; i < words_.languages.size() && !texts.empty(); ++i) {
            known += strings_of(view_in({words_.languages[i]}));
            std::erase_if(texts, [&](const reports::PdfTextBesidePages& one) { return says_only(one.text, known); });
        }
        std::string told;
        constexpr std::size_t k_most_told = 5;
        for (std::size_t i = 0; i < std::min(texts.size(), k_most_told); ++i) {
            told += (told.empty() ? "" : ", ") + std::string(texts[i].what) + " " + text::in_quotes(texts[i].text);
        }
        if (!texts.empty()) {
            findings.take({gum::Diagnostic{
                .code = "GC-ARCHIVE-0071",
                .where = file.string(),
                .what = "beside its pages it has texts that they do not print: " + told +
                        (texts.size() > k_most_told ? " and " + std::to_string(texts.size() - k_most_told) + " more"
                                                    : std::string()) +
                        "; not compared",
                .rule = "pages are made with any template and in any language, and what all of them print is compared",
                .action = "read these texts when the certificate is reviewed",
                .severity = gum::Severity::note}});
        }
    }

    /// The description of the QR code of a head, which is held against the log.
    static bool is_head_of_archive(const std::string& text) {
        const std::vector<PrintedHead> heads = printed_heads_in(text);
        return heads.size() == 1 && text == mark_of(head_of(heads.front()));
    }

    /// Whether each part of a text, between commas and colons, is among others.
    /// \param known  without blanks and hyphens
    static bool says_only(const std::string& text, const std::string& known) {
        if (known.find(reports::without_blanks(text)) != std::string::npos) {
            return true;
        }
        std::string part;
        for (std::size_t i = 0; i <= text.size(); ++i) {
            const bool ends = i == text.size() || ((text[i] == ',' || text[i] == ':' || text[i] == ';') &&
                                                   (i + 1 == text.size() || text[i + 1] == ' '));
            if (ends && known.find(reports::without_blanks(std::exchange(part, {}))) == std::string::npos) {
                return false;
            }
            part += ends ? "" : std::string(1, text[i]);
        }
        return true;
    }

    /// All texts of a view, without blanks and hyphens.
    static std::string strings_of(const nlohmann::json& view) {
        std::string all;
        std::vector<const nlohmann::json*> left{&view};
        while (!left.empty()) {
            const nlohmann::json& one = *left.back();
            left.pop_back();
            if (one.is_string()) {
                all += reports::without_blanks(one.get_ref<const std::string&>()) + '\n';
            }
            if (one.is_structured()) {
                std::transform(one.begin(), one.end(), std::back_inserter(left),
                               [](const nlohmann::json& inner) { return &inner; });
            }
        }
        return all;
    }

    /// With the languages of a document, as the templates name them: "zh-Hant" of "zh".
    reports::RenderAssets in_languages(const fs::path& file, const std::vector<std::string>& languages) const {
        reports::RenderAssets assets = assets_;
        for (const std::string& language : languages) {
            const auto found = std::find_if(
                words_.languages.begin(), words_.languages.end(),
                [&](const std::string& one) { return one == language || one.starts_with(language + '-'); });
            if (found == words_.languages.end() || language.empty()) {
                refuse_disagreement(file, "is in the language " + text::in_quotes(language) +
                                              ", in which this program makes no document");
            } else {
                assets.languages.push_back(*found);
            }
        }
        if (languages.empty() || languages.size() > 2) {
            refuse_disagreement(file, "is in " +
                                          text::count_of(static_cast<std::int64_t>(languages.size()), "language") +
                                          ", not in one or two");
        }
        return assets;
    }

    const std::string& digital_certificate(const reports::RenderAssets& assets) {
        std::string& made = digital_certificates_[{assets.languages, assets.changed_templates}];
        made = made.empty() ? reports::render_dcc(record_, assets) : made;
        return made;
    }

    void require_agreement_of_dcc(const fs::path& file, std::string_view bytes) {
        reports::RenderAssets assets = in_languages(file, reports::languages_of_dcc(bytes, file.string()));
        // Which templates it names is no statement of the record: everything else is that of these templates all the same.
        assets.changed_templates = reports::changed_templates_of_dcc(bytes, file.string());
        refuse_disagreement(file, reports::disagreement_of_dcc(bytes, file.string(), digital_certificate(assets)));
    }
};

std::string worded(const certificate::LocalisedText& text, const certificate::CertificateData& data) {
    return text.in(data.languages.empty() ? "en" : data.languages.front());
}

/// SHA-256 of the record of the original that the job of an amendment was compared with; "" where it names none.
std::string sha256_of_compared(const reports::EvaluationRecord& record, const certificate::Amendment& stated) {
    if (record.certificate) {
        return record.certificate->amended_record_sha256;
    }
    const auto file = std::find_if(record.job_files.begin(), record.job_files.end(),
                                   [&](const reports::InputFile& one) { return one.name == stated.record; });
    return file == record.job_files.end() ? "" : file->sha256;
}

}  // namespace

certificate::CertificateData stated_identity(const reports::EvaluationRecord& record) {
    certificate::CertificateData data;
    if (record.certificate) {
        data = record.certificate->data;
    } else if (record.comparison && record.comparison->issuer) {
        const reports::ComparisonIssuer& issuer = *record.comparison->issuer;
        data.number = issuer.number;
        data.laboratory.name = issuer.laboratory;
        data.dates.issued = issuer.issued;
        data.status = "not_accredited";
        data.languages = record.comparison->languages;
        data.amendment = issuer.amendment;
    }
    return data;
}

CheckedDraft checked_draft(const fs::path& record_file, const std::vector<fs::path>& documents,
                           const ArchiveChecks& checks) {
    CheckedDraft checked;
    const std::string name = record_file.string();
    std::vector<fs::path> files = documents;
    files.push_back(record_file);
    const auto within_walls = [&](const std::function<void()>& work) {
        if (checks.within_walls) {
            checks.within_walls(files, work);
        } else {
            work();
        }
    };
    within_walls([&] {
        checked.draft.record = evaluation::read_file(record_file);
        checked.record = reports::record_from_json(checked.draft.record, name);
    });
    const certificate::CertificateData data = stated_identity(checked.record);
    if (data.number.empty()) {
        const bool compares = checked.record.kind == "comparison";
        throw gum::InputError(gum::Diagnostic{
            .code = "GC-ARCHIVE-0028",
            .where = name,
            .what = compares ? "the record of a comparison whose report has no number"
                             : "a record without certificate data",
            .rule = "an archive keeps certificates and reports, each under its number",
            .action = compares
                          ? "state \"certificate\": {\"number\": …} in the job of the comparison, and evaluate it again"
                          : "state the certificate data in the job, docs/certificate_data.md"});
    }
    const auto evaluate = [&] {
        reports::EvaluationRecord again = checked.record;
        if (const std::optional<gum::Diagnostic> why =
                evaluation::recompute_record(again, name, checks.threads, checks.templates, checks.progress)) {
            throw gum::InputError(*why);
        }
    };
    if (checks.evaluates_within) {
        checks.evaluates_within(evaluate);
    } else {
        evaluate();
    }
    checked.draft.number = data.number;
    if (!checked.record.certificate) {
        checked.draft.item = checked.record.title;  // what was compared
    }
    for (const certificate::Item* item : certificate::items_of(data)) {
        checked.draft.item += (checked.draft.item.empty() ? "" : "; ") + worded(item->description, data);
        checked.draft.item += item->serial_number.empty() ? "" : ", " + item->serial_number;
    }
    within_walls([&] {
        CheckFindings findings;
        DocumentsOfRecord::require_as_written(record_file, checked.draft.record, findings);
        DocumentsOfRecord of_record(checked.record, checks);
        for (const fs::path& document : documents) {
            if (checks.progress) {
                checks.progress("checking " + document.filename().string());
            }
            checked.draft.documents.push_back(of_record.checked(document, findings));
        }
        checked.remarks = std::move(findings).remarks();
    });
    return checked;
}

void state_amendment(CheckedDraft& amendment, const std::string& original) {
    const certificate::Amendment stated = *stated_identity(amendment.record).amendment;
    const auto refuse = [&](std::string what, std::string rule, std::string action) {
        throw gum::InputError(gum::Diagnostic{.code = "GC-ARCHIVE-0035",
                                              .where = amendment.draft.number,
                                              .what = std::move(what),
                                              .rule = std::move(rule),
                                              .action = std::move(action)});
    };
    if (const std::string compared = sha256_of_compared(amendment.record, stated);
        !compared.empty() && compared != encoding::sha256(original)) {
        refuse("was compared with another record of \"" + stated.number + "\" than the archived one",
               "an amendment is compared with what was issued",
               "take the record of the original out of the archive, and evaluate the job again");
    }
    const reports::EvaluationRecord earlier = reports::record_from_json(original, "record of " + stated.number);
    const bool is_report = !amendment.record.certificate;
    if (is_report != !earlier.certificate) {
        refuse("amends \"" + stated.number + "\", which is " +
                   (is_report ? "a certificate" : "the report of a comparison"),
               "certificates amend certificates, and reports of comparisons such reports",
               "correct the number of the original, or add it under a number of its own");
    }
    amendment.draft.amends = Draft::Amends{.number = stated.number, .kind = stated.kind, .changes = {}};
    for (const certificate::Change& change : is_report ? changes_of_report(earlier, amendment.record)
                                                       : reports::changes_between(earlier, amendment.record)) {
        amendment.draft.amends->changes.push_back({change.kind, change.where, change.before, change.after});
    }
    if (amendment.draft.amends->changes.empty()) {
        refuse("differs from \"" + stated.number + "\" in nothing that is compared: " +
                   (is_report ? "in no text, verdict and number of the report; messages, files, and names that are "
                                "confidential, are not compared"
                              : "not in texts of the certificate data, and not in what its tables of "
                                "results show; the order of rows, and annexes, are not compared"),
               "an amendment changes something", "change what is to be amended, or do not amend it");
    }
}

void require_issuable(const std::string& record, const std::string& number, const std::string& day) {
    reports::EvaluationRecord read = reports::record_from_json(record, "record of " + number);
    if (!read.certificate) {  // the report of a comparison has no gates
        read.certificate.emplace().data = stated_identity(read);
    }
    certificate::Certificate& certificate = *read.certificate;
    const bool specimen = certificate.data.status == "specimen";
    const bool early = certificate::block_issue_ahead_of_time(certificate, day);
    if (specimen || certificate.blocked) {
        throw gum::InputError(
            gum::Diagnostic{.code = "GC-ARCHIVE-0030",
                            .where = number,
                            .what = specimen ? "is a specimen"
                                    : early  ? "is dated later than today"
                                             : "has critical findings",
                            .rule = "certificates are issued that nothing blocks, and not ahead of their date",
                            .action = "mend the certificate data or the measurement, and add the new record"});
    }
}

void require_named_person(const std::string& record, const std::string& number, const std::string& kind,
                          const std::string& person) {
    const reports::EvaluationRecord read = reports::record_from_json(record, "record of " + number);
    const certificate::Persons persons = stated_identity(read).persons;
    const bool reviews = kind == "reviewed";
    const std::optional<certificate::Person>& named = reviews ? persons.reviewed_by : persons.authorised_by;
    if (named && !named->name.empty() && !may_be_one_person(named->name, person)) {
        const std::string does = reviews ? " reviews it, and " : " authorises it, and ";
        throw gum::InputError(gum::Diagnostic{
            .code = "GC-ARCHIVE-0039",
            .where = number,
            .what = "prints that " + text::in_quotes(named->name) + does + text::in_quotes(person) + " does",
            .rule =
                reviews
                    ? "a certificate that names who reviewed it names who did, as the log does (ISO/IEC 17025:2017, "
                      "7.8.1.1)"
                    : "a certificate identifies who authorises it (ISO/IEC 17025:2017, 7.8.2.1), and the log says "
                      "the same",
            .action = std::string("let this person ") + (reviews ? "review" : "authorise") +
                      " it, or state the other one in the certificate data and add the new record"});
    }
}

std::vector<gum::Diagnostic> doubts_about_days(const std::string& record, const std::string& number,
                                               const std::string& kind, const std::string& day) {
    const reports::EvaluationRecord read = reports::record_from_json(record, "record of " + number);
    const certificate::Dates dates = stated_identity(read).dates;
    const bool authorises = kind == "authorised";
    const std::string& printed = authorises ? dates.authorised : dates.issued;
    // The log has the day by UTC, and the certificate that of the laboratory.
    constexpr long k_days_between_time_zones = 1;
    if ((!authorises && kind != "issued") || printed.empty() ||
        certificate::days_between(printed, day).value_or(0) <= k_days_between_time_zones) {
        return {};
    }
    return {
        {.code = "GC-ARCHIVE-0072",
         .where = number,
         .what = std::string("prints ") + (authorises ? "that it is authorised on " : "that it is issued on ") +
                 printed + ", and the log says " + day,
         .rule = "a certificate is dated when it is issued (ISO/IEC 17025:2017, 7.8.2.1 j), after it was authorised",
         .action = "where the printed day is not the true one, state this day in the certificate data, and add the new "
                   "record",
         .severity = gum::Severity::warning}};
}

bool states_a_reason(const std::string& text) {
    return certificate::states_a_reason(text);
}

}  // namespace gumcert::archive
