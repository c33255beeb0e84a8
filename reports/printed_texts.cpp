#include "reports/printed_texts.h"

#include "certificate/statement_of_uncertainty.h"
#include "text/numbers.h"

#include <algorithm>

namespace gumcert::reports {

std::optional<std::string> common(const std::vector<std::string>& texts) {
    const bool same =
        !texts.empty() && std::all_of(texts.begin(), texts.end(), [&](const auto& t) { return t == texts.front(); });
    return same ? std::optional<std::string>(texts.front()) : std::nullopt;
}

bool any_of(const std::vector<std::string>& texts) {
    return std::any_of(texts.begin(), texts.end(), [](const std::string& t) { return !t.empty(); });
}

std::string joined(const std::vector<std::string>& texts) {
    std::string out;
    for (const std::string& text : texts) {
        out += (out.empty() ? "" : ", ") + text;
    }
    return out;
}

Text with_unit(const Text& number, const std::string& unit) {
    return unit.empty() || number.empty() ? number : number + ("\u00A0" + unit);
}

std::string percent_text(double probability) {
    return text::without_trailing_zeros(certificate::printed_coverage_probability(probability)) + " %";
}

}  // namespace gumcert::reports
