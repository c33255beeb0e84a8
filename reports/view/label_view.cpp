#include "reports/view/label_view.h"

#include "certificate/dates.h"
#include "certificate/section_data.h"
#include "reports/printable_text.h"
#include "reports/view/certificate_identity_sections.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

namespace gumcert::reports {

namespace {

using nlohmann::json;

constexpr std::array<const char*, 12> k_months = {"january",   "february", "march",    "april",
                                                  "may",       "june",     "july",     "august",
                                                  "september", "october",  "november", "december"};

/// "SN-1001, INV-55": what tells an item from others of its kind; else what it is.
std::string item_on_label(const certificate::Item& item, const Wording& words) {
    std::string text = item.serial_number;
    if (!item.identification.empty()) {
        text += (text.empty() ? "" : ", ") + item.identification;
    }
    return text.empty() ? words.localised(item.description).first() : text;
}

/// That of the certificate, or the items of its sections, as many as are still read on a label.
std::string items_on_label(const certificate::Certificate& certificate, const Wording& words) {
    const certificate::CertificateData& data = certificate.data;
    if (!certificate::stated_by_sections(data, certificate.tables).item) {
        return item_on_label(data.item, words);
    }
    constexpr std::size_t k_most = 3;
    std::string text;
    std::size_t count = 0;
    for (const certificate::Item* item : certificate::items_of(data)) {
        if (item != &data.item && ++count <= k_most) {
            text += (text.empty() ? "" : "; ") + item_on_label(*item, words);
        }
    }
    return count > k_most ? text + " \u2026" : text;
}

}  // namespace

std::string text_of_code(const EvaluationRecord& record) {
    std::string text = record.certificate->data.number;
    if (!record.digest.empty()) {
        std::string digest = record.digest;
        std::transform(digest.begin(), digest.end(), digest.begin(),
                       [](char c) { return c >= 'a' && c <= 'f' ? static_cast<char>(c - 'a' + 'A') : c; });
        text += " SHA-256 " + digest;
    }
    return text;
}

std::string date_in_words(const std::string& date, const Wording& words) {
    if (!certificate::calendar_date(date)) {
        return date;
    }
    const auto without_zero = [](const std::string& digits) { return digits[0] == '0' ? digits.substr(1) : digits; };
    const auto month = static_cast<std::size_t>((date[5] - '0') * 10 + (date[6] - '0'));
    return words
        .filled("date_in_words", "format",
                {{"day", without_zero(date.substr(8, 2))},
                 {"month", words("date_in_words", k_months.at(month - 1))},
                 {"year", date.substr(0, 4)}})
        .first();
}

json label_view(const EvaluationRecord& record, const Wording& words) {
    const certificate::CertificateData& data = record.certificate->data;
    const auto row = [](const Text& label, const std::string& value) {
        return json{{"label", label.first()}, {"value", printable(value)}};
    };
    json rows = json::array({row(words("label_on_item", "item"), items_on_label(*record.certificate, words)),
                             row(words("label_on_item", "certificate"), data.number)});
    const std::string& performed =
        data.dates.performed_to.empty() ? data.dates.performed_from : data.dates.performed_to;
    rows.push_back(row(words("label_on_item", "date"), date_in_words(performed, words)));
    if (!data.recalibration_date.empty() && !data.recalibration_agreement.empty()) {
        rows.push_back(row(words("label_on_item", "recalibration"), date_in_words(data.recalibration_date, words)));
    }
    json mark = json::array();
    if (const std::string status = document_status(record); status != "issued") {
        mark.push_back({{"text", words("certificate_status", status).first()}});
    }
    json accreditation = json::array();
    if (record.certificate->symbol && data.accreditation) {
        accreditation.push_back({{"text", printable(data.accreditation->number)}});
    }
    return {{"language", words.language()},
            {"title", printable(words("label_on_item", "title").first() + " " + data.number)},
            {"attachment", json::array()},
            {"laboratory", printable(words.localised(data.laboratory.name).first())},
            {"accreditation", std::move(accreditation)},
            {"symbol", accreditation_symbol(*record.certificate, words)},
            {"heading", words("label_on_item", "heading").first()},
            {"rows", std::move(rows)},
            {"mark", std::move(mark)},
            {"code", text_of_code(record)}};
}

}  // namespace gumcert::reports
