#include "jobs/budget/stated_point.h"

#include <algorithm>
#include <string_view>

#include "jobs/input_codes.h"
#include "text/lists.h"
#include "text/visible_text.h"

namespace gumcert::jobs {

std::optional<std::size_t> input_of_point(const std::string& name, const std::string& where, const BudgetInputs& inputs,
                                          const std::vector<gum::BudgetFit>& fits, ProblemList& problems,
                                          const std::string* column) {
    if (const auto found = inputs.find(name)) {
        return found;
    }
    if (inputs.is_named(name)) {
        return std::nullopt;
    }
    const bool is_parameter = std::any_of(fits.begin(), fits.end(), [&](const gum::BudgetFit& fit) {
        return std::any_of(fit.parameters.begin(), fit.parameters.end(),
                           [&](const gum::BudgetFit::Parameter& parameter) { return parameter.name == name; });
    });
    if (is_parameter) {
        problems.refuse(k_point_of_fit, where, text::in_quotes(name) + " is a parameter of a fit",
                        "all points share the fits", "remove it");
        return std::nullopt;
    }
    const std::vector<std::string_view> known(inputs.names().begin(), inputs.names().end());
    const auto nearest = nearest_word(name, known);
    // "x.u" is the head of a column; in a point of the job the keys of x stand in an object.
    const std::size_t dot = column == nullptr ? name.find('.') : std::string::npos;
    if (dot != std::string::npos && inputs.find(name.substr(0, dot))) {
        problems.refuse(k_unknown_quantity, where, text::in_quotes(name) + " is the head of a column of a file",
                        "a point of the job states an input by its name, as a number or as an object of its keys",
                        "write " + text::in_quotes(name.substr(0, dot)) + ": {" +
                            text::in_quotes(name.substr(dot + 1)) + ": …}, with all keys of the input in one object");
        return std::nullopt;
    }
    problems.refuse(k_unknown_quantity, where, text::in_quotes(name) + " is none of the inputs",
                    column == nullptr
                        ? "a point states inputs of the job by their names, and its own name as \"point\""
                        : "a point states inputs of the job, by NAME or NAME.key, and its own name as \"point\"",
                    column == nullptr && name.empty() ? "remove it, or name the input"
                    : name.empty()                    ? "give the column a name, or remove it"
                    : nearest                         ? "did you mean " + text::in_quotes(*nearest) + "?"
                              : "correct the name; declare a column for people in the columns of the points, such as "
                                "\"columns\": {" +
                                    text::in_quotes(column == nullptr ? name : *column) + ": \"text\"}");
    return std::nullopt;
}

}  // namespace gumcert::jobs
