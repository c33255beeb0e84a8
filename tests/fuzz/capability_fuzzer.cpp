#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "certificate/capability.h"
#include "certificate/capability_equation.h"
#include "gum/quantity/diagnostic.h"
#include "tests/fuzz/demand.h"

namespace gumcert::fuzz {
namespace {

using certificate::Capability;

std::vector<double> numbers_of(std::string_view line) {
    std::vector<double> numbers;
    while (!line.empty() && numbers.size() < 64) {
        const std::size_t end = std::min(line.find(' '), line.size());
        double value = 0.0;
        if (std::from_chars(line.data(), line.data() + end, value).ec == std::errc()) {
            numbers.push_back(value);
        }
        line.remove_prefix(std::min(end + 1, line.size()));
    }
    return numbers;
}

/// Lines of a text: the form, the expression, places, U there (rows of a matrix one after the other), how it is looked up,
/// what the arguments are.
struct Stated {
    Capability capability;
    std::vector<certificate::ArgumentValue> arguments;
};

Stated stated_capability(std::string_view text) {
    std::vector<std::string_view> lines;
    while (lines.size() < 6) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        lines.push_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    Stated stated;
    Capability& capability = stated.capability;
    capability.form = lines[0];
    capability.unit = "um";
    capability.expression = lines[1];
    const std::vector<double> at = numbers_of(lines[2]);
    const std::vector<double> U = numbers_of(lines[3]);
    capability.lookup = lines[4];
    const std::vector<double> values = numbers_of(lines[5]);
    static const std::vector<std::string> k_names{"L", "t", "alpha"};
    for (std::size_t i = 0; i < std::min(values.size(), k_names.size()); ++i) {
        capability.arguments.push_back({.name = k_names[i], .unit = "m"});
        stated.arguments.push_back({k_names[i], values[i]});
    }
    if (capability.form == "value") {
        capability.U = U.empty() ? 0.0 : U.front();
    } else if (capability.form == "matrix") {
        capability.rows = at;
        capability.columns = at;
        for (std::size_t row = 0; (row + 1) * at.size() <= U.size() && row < at.size(); ++row) {
            const auto begin = U.begin() + static_cast<std::ptrdiff_t>(row * at.size());
            capability.matrix.emplace_back(begin, begin + static_cast<std::ptrdiff_t>(at.size()));
        }
    } else if (capability.form != "function") {
        for (std::size_t i = 0; i < std::min(at.size(), U.size()); ++i) {
            capability.points.push_back({at[i], U[i]});
        }
    }
    return stated;
}

/// What a table says lies between the smallest and the largest of its numbers.
void demand_between(const Capability& capability, double U) {
    double least = capability.U, most = capability.U;
    if (!capability.points.empty()) {
        const auto by_U = [](const auto& a, const auto& b) { return a.U < b.U; };
        const auto [low, high] = std::ranges::minmax_element(capability.points, by_U);
        least = low->U;
        most = high->U;
    } else if (!capability.matrix.empty()) {
        least = most = capability.matrix.front().front();
        for (const std::vector<double>& row : capability.matrix) {
            least = std::min(least, *std::ranges::min_element(row));
            most = std::max(most, *std::ranges::max_element(row));
        }
    }
    constexpr double k_rounding = 1e-12;
    demand(U >= least * (1.0 - k_rounding) && U <= most * (1.0 + k_rounding), "U beyond those that are stated");
}

void use_capability(const Stated& stated) {
    const Capability& capability = stated.capability;
    std::string problem;
    const std::string expanded = certificate::expanded_capability_expression(capability.expression, problem);
    demand(problem.empty() || expanded.empty(), "an expression in spite of a problem");
    const std::vector<certificate::CapabilityProblem> problems = certificate::check_capability(capability);
    for (const certificate::CapabilityProblem& found : problems) {
        demand(!found.what.empty() && !found.rule.empty() && !found.action.empty(), "a problem without words");
    }
    try {
        const certificate::CapabilityAt at = certificate::capability_at(capability, stated.arguments);
        demand(problems.empty(), "used in spite of a problem");
        demand(at.U.has_value() == at.reason.empty(), "neither U nor a reason, or both");
        if (!at.U) {
            return;
        }
        demand(std::isfinite(*at.U) && *at.U > 0.0, "U of a capability");
        if (capability.form == "function") {
            Eigen::VectorXd values(static_cast<Eigen::Index>(stated.arguments.size()));
            for (std::size_t i = 0; i < stated.arguments.size(); ++i) {
                values(static_cast<Eigen::Index>(i)) = stated.arguments[i].value;
            }
            demand(certificate::compile_capability(capability, expanded).evaluate(values)(0) == *at.U,
                   "another value of the expression");
        } else {
            demand_between(capability, *at.U);
        }
    } catch (const gum::InputError& error) {
        const bool is_argument = error.diagnostics().front().code == "GC-CERT-0202";
        demand(is_argument || !problems.empty(), "refused without a problem");
    }
}

}  // namespace
}  // namespace gumcert::fuzz

/// Any capability cannot be used, for a reason, or gives at any place a U greater than 0 or why it gives none.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gumcert::fuzz;
    use_capability(stated_capability({reinterpret_cast<const char*>(data), size}));
    return 0;
}
