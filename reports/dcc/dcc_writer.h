#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reports/dcc/dcc_pieces.h"
#include "reports/dcc/ref_types.h"
#include "reports/dcc/xml_document.h"
#include "reports/record/evaluation_record.h"
#include "reports/wording.h"

namespace gumcert::reports {

/// What every part of a digital certificate is written from, and the few shapes that all parts share.
class DccWriter {
public:
    DccWriter(const EvaluationRecord& record, const Wording& words, const RefTypes& ref_types);

    [[nodiscard]] const EvaluationRecord& record() const { return record_; }
    [[nodiscard]] const Wording& words() const { return words_; }
    [[nodiscard]] const RefTypes& ref_types() const { return ref_types_; }
    /// Of the section that is written, or of all.
    [[nodiscard]] const std::vector<certificate::CertifiedTable>& tables() const {
        return section_ ? section_->tables : tables_;
    }
    [[nodiscard]] const std::vector<certificate::CertifiedTable>& all_tables() const { return tables_; }
    /// Data of the certificate, as they hold for the section that is written; empty ones where the record has none.
    [[nodiscard]] const certificate::CertificateData& data() const { return section_ ? section_->data : data_; }
    /// From here on data and tables are those of one section of the record.
    void enter_section(const std::string& section);
    /// The id of the item that a section is about: its own, or that of the certificate.
    [[nodiscard]] std::string item_id(const std::string& section) const;
    /// Pieces of the sets among the items.
    [[nodiscard]] const SetPieces& pieces() const { return pieces_; }
    /// Beginning of the digest of templates that are not those of the release; "" where they are
    std::string changed_templates;
    [[nodiscard]] bool is_specimen() const { return data_.status == "specimen"; }
    /// True where values are marked as within or outside of the scope of accreditation.
    [[nodiscard]] bool has_scope() const { return data_.status == "accredited" && data_.accreditation.has_value(); }
    /// "not stated", or "not stated (specimen)".
    [[nodiscard]] Text not_stated() const;
    /// Id of the statement with the decision rule of a specification; "" for one that the data does not have.
    [[nodiscard]] std::string specification_id(const std::string& specification) const;
    /// Specifications that a value was held against.
    [[nodiscard]] bool is_decided(const std::string& specification) const;

    XmlWriter xml;

    /// An element of type textType or richContentType: every language once, or one text without a language. An empty
    /// text becomes `not_stated()`.
    void text(const std::string& element, const Text& text, const XmlWriter::Attributes& attributes = {});
    /// The same; nothing for an empty text.
    void optional_text(const std::string& element, const Text& text);
    /// An element of type notEmptyStringType; nothing for an empty text.
    void optional_string(const std::string& element, const std::string& text);
    /// dcc:statement with a declaration.
    void statement(const std::string& ref_type, const Text& declaration, const std::string& id = {});
    /// A dcc:data with a sentence in place of numbers.
    void data_sentence(const Text& sentence);

private:
    void contents(const Text& text);

    const EvaluationRecord& record_;
    const Wording& words_;
    const RefTypes& ref_types_;
    certificate::CertificateData data_;
    std::vector<certificate::CertifiedTable> tables_;
    struct Section {
        certificate::CertificateData data;
        std::vector<certificate::CertifiedTable> tables;
    };
    std::optional<Section> section_;
    SetPieces pieces_;
    std::vector<std::string> languages_;  ///< ISO 639-1
};

void write_administrative_data(DccWriter& writer);
/// Methods, software, equipment and influence conditions of a measurement result.
void write_circumstances(DccWriter& writer);
/// \param with_joint  the covariance of all results of the record stands behind them
void write_results(DccWriter& writer, bool with_joint);

/// Puts a line behind the lines of a text; nothing for an empty one.
void append_line(Text& lines, const Text& line);

/// A language of ISO 639-1: "zh-Hant" → "zh".
[[nodiscard]] std::string iso_639_1(const std::string& language);

/// As xs:date demands it; "" for another text.
[[nodiscard]] std::string date_or_nothing(const std::string& text);

/// Shortest text with a decimal point and at most an exponent: what D-SI accepts as a number.
[[nodiscard]] std::string d_si_number(double value);
/// The printed text where D-SI accepts it as a number, else "NaN".
[[nodiscard]] std::string d_si_number(const std::string& printed);
/// The printed text.
/// \throws gum::NoResultError  GC-DCC-0120 where it is no number: a number must never get lost
[[nodiscard]] std::string required_d_si_number(const std::string& printed, const std::string& where);
/// The printed text where D-SI accepts it as a coverage factor (plain decimal from 1 on), else "NaN".
[[nodiscard]] std::string d_si_coverage_factor(const std::string& printed);
/// A probability without exponent.
[[nodiscard]] std::string d_si_probability(double value);
/// The unit in the notation of D-SI; "|text" for one that D-SI does not have.
[[nodiscard]] std::string d_si_unit(const std::string& udunits);

/// Letters, digits and `_` only, not empty: for ids and names of reference types.
[[nodiscard]] std::string as_token(const std::string& text);

}  // namespace gumcert::reports
