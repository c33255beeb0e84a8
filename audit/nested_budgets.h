#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "audit/audited_budget.h"
#include "audit/budget_outcome.h"
#include "audit/correction_effect.h"
#include "audit/finding.h"
#include "audit/subject.h"

namespace gumcert::audit {

/// How much larger corrections made the contributions of the rows of budgets: one list a budget, one factor a row.
/// \return nothing where they did something that no factor says: a row was added, or one of 0 has a contribution now
[[nodiscard]] std::optional<RowFactors> row_factors(std::span<const AuditedBudget> claimed,
                                                    std::span<const AuditedBudget> corrected);

/// What corrections of nested budgets do to the results that rest on them.
class NestedCorrections {
public:
    /// Evaluates each finding on nested budgets alone, once.
    /// \param subject, findings  must outlive this object; `findings` may take effects meanwhile
    NestedCorrections(const AuditSubject& subject, const std::vector<AuditFinding>& findings);

    [[nodiscard]] bool is_nested(std::size_t budget) const;
    [[nodiscard]] bool is_dependent(std::size_t budget) const;
    /// Positions of the findings whose correction changes the dependent budgets, ascending.
    [[nodiscard]] const std::vector<std::size_t>& findings() const { return changing_; }

    /// Effects on a dependent budget, where corrections of its own are made as well.
    /// \param of  positions of the findings: those of findings(), and others that correct this budget
    [[nodiscard]] std::vector<Effect> effects_on(std::size_t budget, const std::vector<std::size_t>& of) const;
    /// How the shares of effects_on() are found.
    [[nodiscard]] ShareDivision division(std::size_t budget, const std::vector<std::size_t>& of) const;

private:
    const AuditSubject& subject_;
    const std::vector<AuditFinding>& findings_;
    std::vector<AuditedBudget> claimed_;  ///< the nested budgets
    std::vector<std::size_t> changing_;

    [[nodiscard]] std::vector<AuditedBudget> corrected(const std::vector<std::size_t>& chosen) const;
    /// A dependent budget after the corrections of nested budgets; nothing where they do not change it.
    [[nodiscard]] std::optional<AuditedBudget> evaluated_again(std::size_t budget,
                                                               const std::vector<std::size_t>& chosen) const;
    [[nodiscard]] bool changes(std::size_t finding) const;
};

}  // namespace gumcert::audit
