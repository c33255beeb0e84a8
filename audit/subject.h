#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "audit/audited_budget.h"
#include "audit/sentence.h"
#include "certificate/certified_results.h"

namespace gumcert::audit {

/// One item of a comparison, as far as the audit looks at it. All numbers in one unit.
struct AuditedScore {
    std::string name;  ///< of the point or laboratory
    double value = 0.0, u = 0.0, U = 0.0;
    double reference_value = 0.0, reference_u = 0.0, reference_U = 0.0;
    std::optional<double> k, reference_k;
    std::optional<double> en, zeta, z;
    std::optional<double> sigma_pt;
    bool correlation_known = false;  ///< stated, also as 0 with a reason
};

struct AuditedComparison {
    bool between_laboratories = false;  ///< each score is that of another laboratory, which acts on it
    std::vector<AuditedScore> scores;
    std::optional<double> p_low, p_high;      ///< of the sum of squared scores given their covariance
    std::vector<std::string> shared_sources;  ///< standards that both sides name
    bool assigned_value_contains_participant = false, instability_in_reference = false;
    /// Of methods: no more scores above 1 than chance gives in 99 of 100 comparisons, by the evaluation itself.
    bool is_explained_by_chance = false;
    std::string action_record;  ///< what was done where |E_n| > 1; "" nothing is on record
};

struct AuditedWorkbook;

/// What multiplies the standard uncertainties of the rows of some budgets: one list a budget, one factor a row.
using RowFactors = std::vector<std::vector<double>>;

/// Budgets whose results are inputs of other results of the subject, as that of a fixture is of all that is measured with
/// it. What correcting them does to the others, only a new evaluation says.
struct NestedBudgets {
    std::size_t first = 0, count = 0;    ///< their positions in AuditSubject::budgets: first … first + count − 1
    std::vector<std::size_t> dependent;  ///< positions of the budgets that rest on them
    /// The dependent ones in their order, everything evaluated again with the factors; empty where these cannot be put into
    /// the job. Remembers what it was asked.
    /// \throws gum::DiagnosedError where there is no result then
    std::function<std::vector<AuditedBudget>(const RowFactors& factors)> evaluate_again;
};

/// What an audit is made of: one file, or several that belong together.
struct AuditSubject {
    enum class Kind { job, record, table, workbook, certificate };
    Kind kind = Kind::table;
    std::string name;                                     ///< of the file
    std::vector<AuditedBudget> budgets;                   ///< one a result and point
    std::optional<certificate::Certificate> certificate;  ///< data, certified tables and findings of the gates
    /// Of a record without a certificate: what its evaluation found against itself, which no gate has taken.
    std::vector<certificate::Finding> of_evaluation = {};
    std::optional<AuditedComparison> comparison;
    std::optional<NestedBudgets> nested = {};
    std::shared_ptr<const AuditedWorkbook> workbook;  ///< audit/audited_workbook.h; none where no formulas are known
    /// Of a record that was evaluated again: where it says something else than its own job gives, as sentences.
    std::optional<std::vector<std::string>> disagreements;
    std::vector<Sentence> not_read;                 ///< what could not be understood, in sentences
    std::vector<certificate::Waiver> waivers = {};  ///< that have effect (certificate/waiver.h)
};

}  // namespace gumcert::audit
