#pragma once

#include "certificate/certified_results.h"
#include "reports/wording.h"

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace gumcert::reports {

/// Beside a value whose U is the capability of the scope.
inline constexpr const char* k_raised_mark = "#";

/// What the U (or the interval) of a value means; each has a sentence.
enum class Coverage { nothing, none, normal, student_t, convolution, monte_carlo, interval };

/// U = 0 without a coverage factor: the value follows from constants.
[[nodiscard]] bool is_exact(const certificate::CertifiedValue& v);

[[nodiscard]] Coverage coverage_of(const certificate::CertifiedValue& v);

/// Everything that is certified, seen at once: which sentences are needed, which columns, and which marks.
class CertifiedOverview {
public:
    using Holds = std::function<bool(const certificate::CertifiedValue&)>;

    /// \param certificate  must outlive this object
    explicit CertifiedOverview(const certificate::Certificate& certificate);

    /// Those whose U is what the evaluation found, not raised to the capability.
    [[nodiscard]] const std::vector<const certificate::CertifiedValue*>& values(Coverage c) const {
        return by_coverage_.at(static_cast<std::size_t>(c));
    }
    [[nodiscard]] const std::vector<Coverage>& used() const { return used_; }
    /// k is not the same for all, or the profile wants its column.
    [[nodiscard]] bool k_column() const { return k_column_; }
    /// Of values of a t-distribution k is not the same for all: the sentence of their U speaks of ν_eff beside it.
    [[nodiscard]] bool nu_beside_k() const { return nu_beside_k_; }
    /// Whether a table may have ±.
    [[nodiscard]] bool plus_minus() const { return certificate_.profile.plus_minus_in_tables; }
    /// Some values are exact.
    [[nodiscard]] bool exact() const { return exact_; }
    /// Some U is the capability of the laboratory.
    [[nodiscard]] bool raised() const { return raised_; }
    [[nodiscard]] const std::vector<const certificate::CertifiedValue*>& raised_values() const {
        return raised_values_;
    }
    /// More than one sentence is needed for what U means, so that values have the letter or the mark of theirs.
    [[nodiscard]] bool has_letters() const { return used_.size() + (raised_ ? 1U : 0U) > 1; }
    /// The profile wants what is outside of the accreditation in a section of its own.
    [[nodiscard]] bool separates() const;

    /// "(a)", "(b)" … where more than one sentence is needed; "" else.
    [[nodiscard]] std::string letter(Coverage c) const;
    /// Marks beside a value: the letter of its sentence, * outside of the accreditation, ‡ external, # raised to the
    /// capability.
    [[nodiscard]] std::string note(const certificate::CertifiedValue& v) const;
    /// What the marks *, ‡ and # of some values mean, one sentence each; empty without marks. It stands in the caption
    /// of their table, so that it is on the page where they appear.
    [[nodiscard]] Text meaning_of_marks(const Wording& words,
                                        const std::vector<const certificate::CertifiedValue*>& values) const;
    [[nodiscard]] bool is_outside(const certificate::CertifiedValue& v) const;
    [[nodiscard]] bool any(const Holds& holds) const;

private:
    const certificate::Certificate& certificate_;
    std::array<std::vector<const certificate::CertifiedValue*>, 7> by_coverage_;
    std::vector<Coverage> used_;
    std::vector<const certificate::CertifiedValue*> raised_values_;
    bool k_column_ = false, nu_beside_k_ = false, raised_ = false, exact_ = false;
};

/// The values that a sentence is about, by name: "l" where it holds for all values of l, else each with its point,
/// "E[10 mm]", and rows that follow each other by the first and the last of them, "E[10 mm] to E[90 mm]".
[[nodiscard]] std::vector<Text> names_of_values(const certificate::Certificate& certificate,
                                                const CertifiedOverview::Holds& named, const Wording& words);

/// "a, b, c" as each language writes it.
[[nodiscard]] Text enumerated(const std::vector<Text>& names, const Wording& words);

/// Whether a value is printed, and no specification is about it.
[[nodiscard]] bool is_without_verdict(const certificate::CertifiedValue& v);

}  // namespace gumcert::reports
