#include "audit/tables/stated_results.h"

namespace gumcert::audit {

bool is_of_result(Statement statement) {
    switch (statement) {
        case Statement::value:
        case Statement::u_c:
        case Statement::U:
        case Statement::reported_U:
        case Statement::capability:
        case Statement::lower_limit:
        case Statement::upper_limit:
        case Statement::tolerance:
        case Statement::nominal:
        case Statement::reference_value:
        case Statement::reference_U:
            return true;
        default:
            return false;
    }
}

bool is_in_words(Statement statement) {
    return statement == Statement::verdict || statement == Statement::decision_rule || statement == Statement::method ||
           statement == Statement::measurand || statement == Statement::equation;
}

bool is_of_coverage(Statement statement) {
    return statement == Statement::value || statement == Statement::u_c || statement == Statement::nu_eff ||
           statement == Statement::k || statement == Statement::U || statement == Statement::reported_U;
}

bool may_be_part(Statement statement) {
    return statement == Statement::u_c || statement == Statement::U || statement == Statement::reported_U ||
           statement == Statement::capability;
}

}  // namespace gumcert::audit
