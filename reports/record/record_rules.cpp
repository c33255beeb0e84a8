#include "reports/record/record_rules.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "json/canonical_json.h"

namespace gumcert::reports {

using Range = certificate::NumberRule;

const char* text_of_rule(Range range) {
    switch (range) {
        case Range::not_negative:
            return "must be 0 or greater";
        case Range::positive:
            return "must be greater than 0";
        case Range::probability:
            return "must lie between 0 and 1";
        case Range::at_least_one:
            return "must be 1 or greater";
        case Range::one_or_two:
            return "must be 1 or 2";
        case Range::any:
            break;
    }
    return "must be finite";
}

bool is_allowed(double v, Range range) {
    switch (range) {
        case Range::not_negative:
            return v >= 0.0;
        case Range::positive:
            return v > 0.0;
        case Range::probability:
            return v >= 0.0 && v <= 1.0;
        case Range::at_least_one:
            return v >= 1.0;
        case Range::one_or_two:
            return v == 1.0 || v == 2.0;
        case Range::any:
            break;
    }
    return true;
}

std::string record_number(double v) {
    std::string text = std::isnan(v)   ? "NaN"
                       : std::isinf(v) ? "infinity"
                                       : gumcert::json::canonical_json(nlohmann::json(v));
    if (!text.empty() && text.back() == '\n') {
        text.pop_back();
    }
    return text;
}

}  // namespace gumcert::reports
