#pragma once

#include "reports/document_text.h"
#include "reports/wording.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gumcert::reports {

/// Labels and values, one below the other.
using Facts = std::vector<std::pair<Text, Text>>;
/// Rows of a table, one text a column.
using Rows = std::vector<std::vector<Text>>;

/// Adds a fact that has a value.
void add_fact(Facts& facts, const Text& label, const Text& value);

struct Column {
    Text head;
    std::string unit = {};  ///< for people; "" leaves it out
    /// Cells are numbers with a point as decimal sign: they get that of the binding language, and stand below each
    /// other by it.
    bool number = false;
};

/// How a row of a table is set apart from the others.
enum class RowKind { plain, part, closing };

/// Collects the sections and blocks of a certificate as texts, and numbers tables and figures.
class CertificateBuilder {
public:
    /// \param wording  must outlive this object
    explicit CertificateBuilder(const Wording& wording);
    ~CertificateBuilder();
    CertificateBuilder(const CertificateBuilder&) = delete;
    CertificateBuilder& operator=(const CertificateBuilder&) = delete;

    void section(const std::string& id);
    /// A section whose heading is not in the wording.
    void section(const std::string& id, const Text& heading);
    /// Sections from here on are annexes: their headings say so.
    /// \param outside  of the accreditation, which the headings say as well
    void annexes(bool outside = false) {
        annexes_ = true;
        outside_ = outside;
    }
    /// The document is for those who look at everything: its lists go on where those of a certificate end.
    void unabridged() { unabridged_ = true; }
    /// How many entries a list may have.
    /// \param on_a_certificate  the limit where a page is for the customer
    [[nodiscard]] std::size_t most(std::size_t on_a_certificate) const {
        constexpr std::size_t k_times = 50;  // beyond it nobody reads, and setting the pages takes minutes
        return unabridged_ ? k_times * on_a_certificate : on_a_certificate;
    }
    void paragraph(const Text& text);
    void formula(const Text& text);
    void definitions(const Facts& rows);
    /// \param drawing  SVG; its numbers get the decimal sign of the binding language
    void figure(const std::string& id, const Text& caption, const std::string& alternative_text,
                const std::string& drawing);
    /// \param rows    one text a column; "" is printed as "–"
    /// \param groups  heads above the heads, each over a number of columns; empty: none
    /// \param kinds   one a row; empty: all plain
    void table(const std::string& id, const Text& caption, const std::vector<Column>& columns, const Rows& rows,
               const std::vector<std::pair<Text, std::size_t>>& groups = {}, const std::vector<RowKind>& kinds = {});

    /// Cells that were printed as "–", of all tables so far.
    [[nodiscard]] std::size_t absent_cells() const { return absent_cells_; }

    /// The sections; the builder is empty afterwards.
    [[nodiscard]] nlohmann::json take();

private:
    const Wording& wording_;
    std::unique_ptr<nlohmann::json> sections_;
    int tables_ = 0;
    int figures_ = 0;
    std::size_t absent_cells_ = 0;
    bool annexes_ = false, outside_ = false, unabridged_ = false;

    void block(const char* kind, nlohmann::json content);
};

/// A text in the second language of a document as the view holds it: an array of one {text, language}, or an empty one
/// where the document has one language or both texts are the same. Texts that differ by the decimal sign only are the
/// same: "0,5 / 0.5" would read as a quotient.
[[nodiscard]] nlohmann::json also(const Text& text, const std::vector<std::string>& languages);

/// Puts a text under `key`, and what also() makes of it under `key` + "_also".
void put(nlohmann::json& object, const std::string& key, const Text& text, const std::vector<std::string>& languages);

/// A number of the record that has no printed form of its own: shortest text, U+2212 as minus sign.
[[nodiscard]] std::string plain(double v);
[[nodiscard]] std::string plain(std::int64_t v);

/// A drawing whose texts that are plain numbers (ticks of the axes, above all) have a decimal sign of the language.
[[nodiscard]] std::string with_decimal_signs(const std::string& drawing, const std::string& sign);
/// What stands invisibly behind the numbers of a column, so that they stand below each other by their decimal sign: zeros
/// up to the longest fraction. None where that would be wider than anybody compares.
/// \param texts  as they are shown, with the decimal sign of the document
[[nodiscard]] std::vector<std::string> pads_of(const std::vector<std::string>& texts, const std::string& sign);

/// Degrees of freedom, as certificate::printed_degrees_of_freedom prints them; a word for infinitely many.
[[nodiscard]] Text degrees_of_freedom(const std::optional<double>& nu, const Wording& words);
/// "ν_eff = 12"; "ν_eff > 9999" of a number that is printed as ">9999".
[[nodiscard]] Text stated_degrees_of_freedom(const std::string& printed, const Wording& words);

}  // namespace gumcert::reports
