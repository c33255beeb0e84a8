#include "gum/comparison/refusal_place.h"

#include <vector>

#include "gum/quantity/diagnostic.h"

namespace gumcert::gum {

void at_place(const std::string& where, const std::function<void()>& work) {
    const auto placed = [&](std::vector<Diagnostic> problems) {
        for (Diagnostic& problem : problems) {
            if (!problem.where.starts_with(where)) {
                problem.where = where + ", " + problem.where;
            }
        }
        return problems;
    };
    try {
        work();
    } catch (const InputError& refused) {
        throw InputError(placed(refused.diagnostics()));
    } catch (const NoResultError& failed) {
        throw NoResultError(placed(failed.diagnostics()));
    }
}

}  // namespace gumcert::gum
