#pragma once

#include "reports/wording.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace gumcert::reports {

struct Column {
    std::string head;
    std::string unit;  ///< for people; "" leaves it out
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
    void section(const std::string& id, const std::string& heading);
    void paragraph(const std::string& text);
    void formula(const std::string& text);
    void definitions(const std::vector<std::pair<std::string, std::string>>& rows);
    /// \param drawing  SVG
    void figure(const std::string& id, const std::string& caption, const std::string& alternative_text,
                const std::string& drawing);
    /// \param rows    one text a column; "" is printed as "–"
    /// \param groups  heads above the heads, each over a number of columns; empty: none
    /// \param kinds   one a row; empty: all plain
    void table(const std::string& id, const std::string& caption, const std::vector<Column>& columns,
               const std::vector<std::vector<std::string>>& rows,
               const std::vector<std::pair<std::string, std::size_t>>& groups = {},
               const std::vector<RowKind>& kinds = {});

    /// The sections; the builder is empty afterwards.
    [[nodiscard]] nlohmann::json take();

private:
    const Wording& wording_;
    std::unique_ptr<nlohmann::json> sections_;
    int tables_ = 0;
    int figures_ = 0;

    void block(const char* kind, const nlohmann::json& content);
};

/// A number of the record that has no printed form of its own: shortest text, U+2212 as minus sign.
[[nodiscard]] std::string plain(double v);
[[nodiscard]] std::string plain(std::int64_t v);

/// A coverage factor or a redundancy, rounded for display.
[[nodiscard]] std::string fixed(double v, int decimals);

/// Degrees of freedom as documents state them: the next lower whole number (JCGM 100:2008, G.4.1, note 1); from 10 000
/// on their digits say nothing.
[[nodiscard]] std::string whole_below(double v);

/// Effective degrees of freedom with one decimal below 100, so that k can be looked up for them: k is taken for ν_eff
/// as it is, and t(16.8) is not t(16).
[[nodiscard]] std::string degrees_of_freedom(double v);

}  // namespace gumcert::reports
