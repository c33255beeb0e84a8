#include "laboratory/applicability.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "certificate/dates.h"
#include "gum/quantity/unit.h"
#include "laboratory/outlook.h"
#include "text/numbers.h"

namespace gumcert::laboratory {

namespace {

constexpr double k_same_value = 1e-9;

/// Keeps the first "no", else the first "unknown".
void put(Applicability& verdict, Answer answer, std::string because, bool is_of_validity = false) {
    // "No" outweighs "unknown": what is refuted is not made open again by what nobody knows.
    if (verdict.answer == Answer::yes || (verdict.answer == Answer::unknown && answer == Answer::no)) {
        verdict = {answer, std::move(because), is_of_validity};
    }
}

using Results = std::vector<const CalibrationResult*>;

std::set<std::string> values_of(const Results& results, std::string CalibrationResult::*member) {
    std::set<std::string> values;
    for (const CalibrationResult* result : results) {
        values.insert(result->*member);
    }
    return values;
}

void keep(Results& results, std::string CalibrationResult::*member, const std::string& value) {
    std::erase_if(results, [&](const CalibrationResult* result) { return result->*member != value; });
}

/// \return false where nothing is left to be looked at
bool narrow(Results& results, std::string CalibrationResult::*member, const std::string& stated, const char* word,
            Applicability& verdict) {
    const std::set<std::string> values = values_of(results, member);
    if (stated.empty()) {
        if (values.size() > 1) {
            put(verdict, Answer::unknown,
                std::string("the certificate has several ") + word + "s, and the use does not say which");
            return false;
        }
        return true;
    }
    if (values.contains(stated)) {
        keep(results, member, stated);
        return true;
    }
    // A certificate that is silent on the range may still hold for it; one that names other ranges only does not.
    if (values.contains("")) {
        put(verdict, Answer::unknown,
            std::string("the certificate does not say for which ") + word + " it holds, and the use is in \"" + stated +
                "\"");
        keep(results, member, "");
        return true;
    }
    put(verdict, Answer::no, std::string("the certificate has no ") + word + " \"" + stated + "\"");
    results.clear();
    return false;
}

void by_date(const StandardRecord& record, const StandardUse& use, Candidates& found) {
    found.calibration = calibration_on(record, use.date);
    if (found.calibration == nullptr) {
        put(found.verdict, Answer::no, "it was not calibrated before " + use.date, true);
        return;
    }
    if (use.date.empty()) {
        put(found.verdict, Answer::unknown, "the day of use is not stated");
        return;
    }
    const std::string& valid_to = found.calibration->valid_to;
    const std::string last_day = valid_to.empty() ? calibration_outlook(record, use.date).last_day : valid_to;
    if (last_day.empty()) {
        put(found.verdict, Answer::unknown, "the register does not say until when its calibration is valid", true);
    } else if (certificate::is_after(use.date, last_day)) {
        put(found.verdict, Answer::no,
            (valid_to.empty() ? "by its plan its calibration was due on " : "its calibration was valid to ") +
                last_day + ", and it was used on " + use.date,
            true);
    }
}

void by_value(const StandardRecord& record, const StandardUse& use, const Results& results, Applicability& verdict) {
    if (results.empty()) {
        return;
    }
    if (!use.at) {
        if (results.size() > 1) {
            put(verdict, Answer::unknown, "the certificate has several values, and the use does not say which");
        }
        return;
    }
    const double at = *use.at;
    const std::string at_in_words = value_in_words(at, results);
    std::optional<double> least, largest;
    bool is_open = false;
    for (const CalibrationResult* result : results) {
        if ((result->nominal && is_same_value(*result->nominal, at)) ||
            (result->low && result->high && *result->low <= at && at <= *result->high)) {
            return;
        }
        is_open = is_open || (!result->nominal && !result->low);
        if (result->nominal) {
            least = std::min(least.value_or(*result->nominal), *result->nominal);
            largest = std::max(largest.value_or(*result->nominal), *result->nominal);
        }
    }
    if (is_open) {
        put(verdict, Answer::unknown, "the certificate does not say for which values it holds");
    } else if (least && *least < at && at < *largest) {
        if (record.interpolation == Interpolation::none) {
            put(verdict, Answer::unknown,
                at_in_words +
                    " lies between two calibrated values, and the register states no "
                    "interpolation");
        }
    } else {
        put(verdict, Answer::no, at_in_words + " lies outside of the values that were calibrated");
    }
}

}  // namespace

std::string value_in_words(double at, const std::vector<const CalibrationResult*>& lines) {
    std::set<std::string> units;
    for (const CalibrationResult* line : lines) {
        units.insert(line->nominal_unit.empty() ? line->unit : line->nominal_unit);
    }
    // In which of several units the number stands is not for this text to say.
    const std::string unit = units.size() == 1 ? gum::unit_for_people(*units.begin()) : std::string();
    return text::shortest_plain(at) + (unit.empty() ? "" : " " + unit);
}

bool is_same_value(double a, double b) {
    // Relative: nominal values of 1e-12 F and of 1e9 Ω are compared alike, and a conversion of units must not separate
    // them.
    return std::abs(a - b) <= k_same_value * std::max(std::abs(a), std::abs(b));
}

Candidates candidates_for(const StandardRecord& record, const StandardUse& use) {
    Candidates found;
    by_date(record, use, found);
    if (found.calibration == nullptr) {
        return found;
    }
    for (const CalibrationResult& result : found.calibration->results) {
        found.results.push_back(&result);
    }
    if (use.quantity.empty()) {
        if (values_of(found.results, &CalibrationResult::quantity).size() > 1) {
            put(found.verdict, Answer::unknown,
                "the certificate has several quantities, and the use does not say which");
            found.is_narrowed = false;
            return found;
        }
    } else {
        keep(found.results, &CalibrationResult::quantity, use.quantity);
        if (found.results.empty()) {
            put(found.verdict, Answer::no, "the certificate has no quantity \"" + use.quantity + "\"");
            return found;
        }
    }
    found.is_narrowed = narrow(found.results, &CalibrationResult::range, use.range, "range", found.verdict) &&
                        narrow(found.results, &CalibrationResult::mode, use.mode, "mode", found.verdict);
    return found;
}

Applicability applicability(const StandardRecord& record, const StandardUse& use) {
    Candidates found = candidates_for(record, use);
    by_value(record, use, found.results, found.verdict);
    return found.verdict;
}

}  // namespace gumcert::laboratory
