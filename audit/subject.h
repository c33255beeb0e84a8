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
    std::string name;                      ///< of the point or laboratory
    double value = 0.0, u = 0.0, U = 0.0;  ///< u and U of 0: not stated
    double reference_value = 0.0, reference_u = 0.0, reference_U = 0.0;
    std::optional<double> k, reference_k;
    /// The scores were evaluated by this program: what it has no score for has none, and U of both sides are those that
    /// E_n takes. Its k differ where degrees of freedom do, so that the probabilities stand in their place.
    bool is_evaluated = false;
    std::optional<double> probability, reference_probability;  ///< that U covers; none: not known, or not used in E_n
    std::optional<double> en, zeta, z;
    std::optional<double> sigma_pt;
    bool correlation_known = false;  ///< stated, also as 0 with a reason
    /// |E_n| above 1 is a signal to act on. Not where the evaluation gives none, because the value that the result was held
    /// against is one of several.
    bool is_signal = true;
    /// Whether the evaluation has no objection to the scores of its direction together: by the distribution that it
    /// took, with its degrees of freedom, the largest of them is one of chance.
    bool is_without_objection = false;
};

/// What was compared with one assigned value: an item in one round, or everything where there are no items.
struct AuditedItem {
    std::string name;  ///< "" of a comparison with one item
    /// p of the test of all results for consistency, and the p below which it is not passed; none: it was not made.
    std::optional<double> p_consistent;
    double threshold = 0.05;
    bool by_chance = false;                 ///< not passed, as one of several items is by chance
    std::optional<double> p_low;            ///< of the same test: probability of so little scatter
    std::vector<std::string> inconsistent;  ///< laboratories outside of the largest consistent subset
    bool has_stability = false;  ///< the stability of the artefact is in the uncertainty of the value, or was shown
};

struct AuditedComparison {
    bool between_laboratories = false;  ///< each score is that of another laboratory, which acts on it
    double score_probability = 0.9545;  ///< of the U that E_n takes
    std::vector<AuditedScore> scores;
    std::optional<double> p_low, p_high;  ///< of the sum of squared scores given their covariance
    /// What the evaluation tested of each item. With items, consistency is theirs to tell: the sum of the scores holds all
    /// results against the assigned value, which is made of some of them.
    std::vector<AuditedItem> items;
    std::vector<std::string> shared_sources;  ///< standards that both sides name
    bool assigned_value_contains_participant = false, instability_in_reference = false;
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
