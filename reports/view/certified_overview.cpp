#include "reports/view/certified_overview.h"

#include "reports/printed_texts.h"

#include <algorithm>

namespace gumcert::reports {

namespace {

using certificate::CertifiedColumn;
using certificate::CertifiedTable;
using certificate::CertifiedValue;

constexpr std::array<Coverage, 6> k_coverages = {Coverage::normal,      Coverage::student_t, Coverage::convolution,
                                                 Coverage::monte_carlo, Coverage::interval,  Coverage::none};

}  // namespace

bool is_exact(const CertifiedValue& v) {
    return v.printed_U == "0" && v.printed_k.empty();
}

Coverage coverage_of(const CertifiedValue& v) {
    if (v.interval && !v.printed_low.empty()) {
        return Coverage::interval;
    }
    if (is_exact(v)) {
        return Coverage::nothing;  // U = 0 is no multiple of a standard uncertainty
    }
    if (v.printed_U.empty()) {
        return v.coverage == "none" ? Coverage::none : Coverage::nothing;
    }
    if (v.coverage == "convolution") {
        return Coverage::convolution;
    }
    if (v.coverage == "monte_carlo") {
        return Coverage::monte_carlo;
    }
    return v.coverage == "student_t" && v.nu_eff ? Coverage::student_t : Coverage::normal;
}

CertifiedOverview::CertifiedOverview(const certificate::Certificate& certificate) : certificate_(certificate) {
    std::vector<std::string> ks;
    for (const CertifiedTable& table : certificate.tables) {
        for (const CertifiedColumn& column : table.columns) {
            for (const CertifiedValue& v : column.values) {
                const Coverage c = coverage_of(v);
                exact_ = exact_ || is_exact(v);
                if (c == Coverage::nothing) {
                    continue;
                }
                by_coverage_.at(static_cast<std::size_t>(c)).push_back(&v);
                if (!v.printed_k.empty() && c != Coverage::interval) {
                    ks.push_back(v.printed_k);
                }
                raised_ = raised_ || v.raised;
            }
        }
    }
    k_column_ = !ks.empty() && (certificate.profile.k_position == "column" || !common(ks));
    std::vector<std::string> student_ks;
    for (const CertifiedValue* const v : values(Coverage::student_t)) {
        student_ks.push_back(v->printed_k);
    }
    nu_beside_k_ = !student_ks.empty() && !common(student_ks);
    for (const Coverage c : k_coverages) {
        if (!values(c).empty()) {
            used_.push_back(c);
        }
    }
}

bool CertifiedOverview::separates() const {
    return certificate_.profile.mixed_results == "separate";
}

std::string CertifiedOverview::letter(Coverage c) const {
    const auto at = std::find(used_.begin(), used_.end(), c);
    return used_.size() < 2 || at == used_.end()
               ? ""
               : std::string("(") + static_cast<char>('a' + (at - used_.begin())) + ")";
}

std::string CertifiedOverview::note(const CertifiedValue& v) const {
    std::string text = letter(coverage_of(v));
    const auto mark = [&](const char* m) { text += (text.empty() ? "" : " ") + std::string(m); };
    if (is_outside(v)) {
        mark("*");
    }
    if (v.external) {
        mark("‡");
    }
    if (v.raised) {
        mark(k_raised_mark);
    }
    return text;
}

Text CertifiedOverview::meaning_of_marks(const Wording& words, const std::vector<const CertifiedValue*>& values) const {
    Text text;
    const auto mark = [&](const Text& sentence) { text += text.empty() ? sentence : " " + sentence; };
    const auto some = [&](const Holds& holds) {
        return std::any_of(values.begin(), values.end(), [&](const CertifiedValue* v) { return holds(*v); });
    };
    if (!separates() && some([&](const auto& v) { return is_outside(v); })) {
        mark(words("statement", "outside_mark"));
    }
    if (some([](const auto& v) { return v.external; })) {
        mark(words.filled("statement", "external_mark", {{"heading", words("heading", "external")}}));
    }
    if (some([](const auto& v) { return v.raised; })) {
        mark(words("statement", "raised_mark"));
    }
    return text;
}

bool CertifiedOverview::is_outside(const CertifiedValue& v) const {
    return certificate_.data.status == "accredited" && v.scope_entry.empty() && !v.printed_value.empty();
}

bool CertifiedOverview::any(const Holds& holds) const {
    for (const CertifiedTable& table : certificate_.tables) {
        for (const CertifiedColumn& column : table.columns) {
            if (std::any_of(column.values.begin(), column.values.end(), holds)) {
                return true;
            }
        }
    }
    return false;
}

}  // namespace gumcert::reports
