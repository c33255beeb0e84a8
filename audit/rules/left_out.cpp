#include <array>

#include "audit/rules/registry.h"

namespace gumcert::audit {
namespace {

// One a line, in the order of the catalogue. An id moves from here to its family when its data are stated somewhere.
constexpr std::array k_left_out{
    RuleLeftOut{"U04", "Pooled standard deviation out of date or from another range",
                "no table, job or record says when and for which range a pooled value was found"},
    RuleLeftOut{"U07", "Readings excluded without a reason",
                "tables hold the readings that are left; a job demands the reason itself"},
    RuleLeftOut{"S14", "Budget linearised at the nominal value",
                "no table states the point of linearisation; S02 and S17 find coefficients of another point"},
    RuleLeftOut{"K10", "Budget older than method, instrument or software", "budgets carry no dates of changes"},
    RuleLeftOut{"W15", "One quantity with two values in a file",
                "names alone do not tell whether two numbers belong to one quantity or to two points"},
    RuleLeftOut{"T09", "Intermediate check overdue or failed", "no register of intermediate checks is read"},
    RuleLeftOut{"T10", "Software of an instrument changed since validation",
                "no data state the version of an instrument's software"},
    RuleLeftOut{"R10", "Page count, page identification or end mark missing",
                "the audit reads no rendered documents; those of the program have all three by construction"},
    RuleLeftOut{"P06", "Program or configuration not the validated one", "no register of validated versions is read"},
};

}  // namespace

std::span<const RuleLeftOut> rules_left_out() {
    return k_left_out;
}

}  // namespace gumcert::audit
